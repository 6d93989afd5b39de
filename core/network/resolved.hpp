#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// A time above 0 that may be 0 (a delay), but is below the resolution of time in the run.
bool is_lost(const Scene& scene, const Parameter& parameter, double value);

/// The values of an element [SI], without the effects that the scene leaves out. Lost times are set to 0. Throws SimulationError where an effect cannot be left out.
std::vector<double> resolved_values(const Scene& scene, const SceneElement& element);

}  // namespace rheonet
