#pragma once

#include <vector>

#include "core/result/manner.hpp"

namespace rheonet {

/// The usual manner first, then all others that change cost or accuracy and make sense for the scene. These are lower
/// orders; events not located, if there are any; reductions switched off, if they reduce the scene
/// (core/network/reductions.hpp); and alternatives that components declare (core/network/alternatives.hpp), whose velocities
/// and displacements are small shares of those in the run. Throws SimulationError if the scene cannot be simulated.
std::vector<Manner> manners(const Scene& scene);

}  // namespace rheonet
