#pragma once

#include <atomic>
#include <vector>

#include "core/result/simulation_method.hpp"

namespace rheonet {

/// The usual method first, then all others that change cost or accuracy and make sense for the scene. These are lower
/// orders; events not located, if there are any; reductions switched off, if they reduce the scene
/// (core/network/reductions.hpp); and alternatives that components declare (core/network/surrogate_laws.hpp), whose velocities
/// and displacements are small shares of those in the run. Throws SimulationError if the scene cannot be simulated, and when
/// `interrupt` is set to true.
std::vector<SimulationMethod> methods(const Scene& scene, const std::atomic<bool>* interrupt = nullptr);

}  // namespace rheonet
