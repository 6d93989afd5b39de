#pragma once

#include "core/solve/mode_cache.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Steps that leap over a change of a law which their ends do not show, such as the peak of friction just before rest.
///
/// A step that ends in an event is looked at on the way to it. Where the equations have other rates there than the step, it is repeated in parts.
class LeapsOverLaws {
 public:
  /// Whether the last step, which ends in an event, is to be repeated. Not more than `numerics::leapt_repeats` times for one event.
  bool repeat(System& system, const Tolerances& tolerances);
  /// Whether steps at t [s], at an event or not, are past those that were repeated, and may be long again.
  bool passed(double t, bool event);

 private:
  int repeats_ = 0;   ///< on the way to one event
  double until_ = 0;  ///< end of the step that was repeated [s]
};

}  // namespace rheonet
