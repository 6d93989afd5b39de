#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// Every closed form is checked at each of these.
inline constexpr double accuracies[] = {1e-3, 1e-6, 1e-9};

/// The exact answer as a function of time. At a jump: the value just after.
using Exact = std::function<double(double t)>;

struct Expectation {
  std::string column;
  Exact exact;
  /// The largest magnitude in the run where it is not seen in the rows (a quantity that is 0 but for an instant).
  double scale = 0;
};
using Expectations = std::vector<Expectation>;

/// Checks that at every row abs(computed - exact) <= 10 accuracy max(abs(exact)): ten times the promised error. A failure names the row with
/// the largest error.
void check_against(const RunTable& trajectory, const Expectation& expected, double accuracy);

/// Runs the netlist at each of `accuracies` and checks every expectation at each.
void check_at_all_accuracies(const std::string& toml, const Expectations& expected);

/// For netlists without a closed form: runs the netlist at `accuracy` and at `closest`, and checks that each of these columns, which must not
/// jump, differs at every row by at most 10 accuracy max(abs(closer)).
void check_against_closer(const std::string& toml, double accuracy, const std::vector<std::string>& columns, double closest = 1e-10);

/// A function that begins at `start`; before it, the constant `before`.
Exact from(double start, Exact after, double before = 0);

/// A netlist of named values, the given tables, and `rows` rows from 0 to `stop` [s].
using Named = std::initializer_list<std::pair<std::string_view, double>>;
std::string netlist(Named parameters, std::string_view tables, double stop, int rows = 201);

/// A last line for such a netlist, which records the expected columns; some are not recorded by default.
std::string record(const Expectations& expected);

}  // namespace rheonet::test
