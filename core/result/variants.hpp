#pragma once

#include <vector>

#include "core/result/manner.hpp"

namespace rheonet {

/// The usual manner, and all that cost or save something and make sense for the scene: lower orders; events that are not
/// located, where there are any; reductions that are not made, where they make something smaller
/// (core/network/reductions.hpp); and what components declare that stands in for them (core/network/alternatives.hpp), with
/// velocities and displacements that are small shares of those in the run. The first is the usual one. Throws
/// SimulationError where the scene cannot be simulated.
std::vector<Manner> manners(const Scene& scene);

}  // namespace rheonet
