#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// The values of an element, without the effects that the scene leaves out; times that mean something at 0 too (a delay) are
/// 0 if they are shorter than what tells the times of the run apart: nothing can come so much later. [SI] Throws
/// SimulationError where an effect cannot be left out.
std::vector<double> resolved_values(const Scene& scene, const SceneElement& element);

}  // namespace rheonet
