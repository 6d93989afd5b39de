#pragma once

#include <vector>

#include "core/solve/mode_cache.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Steps that leap over what their ends do not show: the peak of friction just before rest, or a pulse of an input.
///
/// A step that ends in an event is looked at on the way to it, any step at the hidden times of inputs. Where the equations have other rates there
/// than the step, it is repeated in parts.
class LeapsOverChanges {
 public:
  /// Whether the last step, which ends in an event, is to be repeated. Not more than `numerics::leapt_repeats` times for one event.
  bool repeat_to_event(System& system, const Tolerances& tolerances);
  /// The same for any step, if the equations have other rates at one of these times within it.
  bool repeat(System& system, const Tolerances& tolerances, const std::vector<double>& times);
  /// Whether steps at t [s], at an event or not, are past those that were repeated, and may be long again.
  bool passed(double t, bool event);

 private:
  int repeats_ = 0;   ///< on the way to one event, or over one step
  double until_ = 0;  ///< end of the step that was repeated [s]
};

}  // namespace rheonet
