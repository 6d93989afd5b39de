#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// A random chain: stages in series with nothing but massless nodes between them, so that all stages carry one force. Parameters
/// and drives are spread evenly over 12 decades. The chain of a number is the same on every machine.
struct Chain {
  enum class Kind {
    steady,   ///< Single elements between ground and a motion of constant velocity: the force has a closed form.
    driven,   ///< From a motion (sine, triangle, ramp, step; a velocity or a position) to ground.
    between,  ///< Between two motions.
    pushed,   ///< From a force, with a mass there or not, to ground.
    hung,     ///< From a motion to a mass.
    grouped,  ///< Like `driven`, in rotation, written as nested `series` and `parallel`.
  };
  static constexpr int kinds = 6;

  struct Member {
    std::string name, type;
    std::vector<std::pair<const char*, double>> values;  ///< parameters of the law, SI
    double sign;                                         ///< -1 if its ends are the other way round

    double value(const std::string& parameter) const;  ///< fails the test if there is none
    bool has(const std::string& parameter) const;
  };

  int number;
  Kind kind;
  std::vector<std::vector<Member>> stages;  ///< each of elements side by side
  double speed = 0;                         ///< of the motion, if `kind` is `steady` [m/s]
  std::string toml;
};

Chain random_chain(int number);

/// How far the forces of neighbouring stages are apart at the worst row, as a share of the larger force's largest magnitude. The
/// rounding of the largest force of a member is not counted.
double stages_apart(const Chain& chain, const std::vector<std::vector<double>>& rows);

/// How far the force of any element of a `steady` chain is from the closed form, in the same measure. The first row is not
/// compared: a force may rise there within the rounding of the time.
double off_closed_form(const Chain& chain, const std::vector<double>& times, const std::vector<std::vector<double>>& rows);

}  // namespace rheonet::test
