#pragma once

#include "core/solve/mode_cache.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Whether the last step, which an event ends, has leapt over a change of a law that its ends do not show, as over the peak of friction just
/// before rest: on the way to the event the equations then have other rates than the step.
bool leaps_over_law(System& system, const Tolerances& tolerances);

}  // namespace rheonet
