#pragma once

#include <cmath>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test {

/// As check_at_all_accuracies, but for the rows that lie nearer to one of `jumps` than a jump may be displaced: the
/// accuracy times the run's length. Accelerations and forces of sliders jump when they stick, velocities of massless
/// nodes also when they slip.
void check_between(const std::string& toml, const Expectations& expected, const std::vector<double>& jumps);

/// Checks that the run has an event at each of `changes`, and none but at these and where the drive jumps (`drive`), to
/// the accuracy times the run's length. The netlist is to ask for `output.events`.
/// Where `creeps` holds at an accuracy the exact motion is one that comes to rest in the limit only, with a velocity that the
/// accuracy does not tell from none: there it may stop.
void check_events(const std::string& toml, const std::vector<double>& changes, const std::vector<double>& drive = {},
                  const std::function<bool(double t, double accuracy)>& creeps = {});

/// Checks that a column has this value to the last bit in every row from `since` to `until`.
void check_exactly(const RunTable& rows, const std::string& column, double value, double since = 0,
                   double until = HUGE_VAL);

/// Checks that a column does not change from `since` on, by a single bit or by more than `rounding`. Its value there.
double check_constant(const RunTable& rows, const std::string& column, double since, double rounding = 0);

/// A run with its summary, for the notes and the energy account.
struct Outcome {
  RunTable rows;
  Summary summary;
};
Outcome outcome(const std::string& toml, double accuracy = 0);

/// How many notes of a run name all of these.
int notes_naming(const Summary& summary, const std::vector<std::string>& names);

/// Supplied = stored + dissipated in total, and each as given [J].
struct Account {
  double supplied, stored, dissipated;
};
void check_account(const std::string& toml, const Account& exact);

}  // namespace rheonet::test
