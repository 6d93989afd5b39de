#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// The values of an element [SI], without the effects that the scene leaves out. A time that may be 0 (a delay) is set to 0
/// if it is below the resolution of time in the run. Throws SimulationError where an effect cannot be left out.
std::vector<double> resolved_values(const Scene& scene, const SceneElement& element);

}  // namespace rheonet
