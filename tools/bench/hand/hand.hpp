#pragma once

#include <vector>

namespace rheonet::hand {

/// What a program written by hand for one scene gives: its equations in IDA, as a careful engineer writes them.
struct Run {
  std::vector<double> values;  ///< the scene's one record, at the times asked for
  long steps = 0;
  long events = 0;
};

/// The scenes are those of scenes.hpp, with the same numbers. `tolerance` is IDA's relative one; `times` ascend from 0, and the
/// last is where the run ends. Throw std::runtime_error if IDA gives up.
Run maxwell(double tolerance, const std::vector<double>& times);
Run stick_slip(double tolerance, const std::vector<double>& times);
Run ladder(int masses, double tolerance, const std::vector<double>& times);
Run iwan(int pairs, double tolerance, const std::vector<double>& times);

}  // namespace rheonet::hand
