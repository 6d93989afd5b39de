#pragma once

#include <vector>

#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

class BlockSignals;

/// Whether a sensor value is known only once all forces at the same time are. `firm`: see firm_nodes.
bool follows_forces(const Network& network, const Blocks::Sensor& sensor, const Structure& classified, const std::vector<char>& firm);

/// Throws SimulationError where a block senses the velocity of a node that has none of its own.
void check_sensors(const Network& network, const Structure& classified);

/// Throws SimulationError if a force would depend on itself at the same time (an algebraic loop), or a motion on velocities.
void refuse_loops(const Network& network, const BlockSignals& blocks, const Structure& classified);

/// The outputs of all blocks in equilibrium under the present outputs of their generators, and the states there. 0 for outputs that depend on
/// how the network moves.
struct SteadyBlocks { std::vector<double> out, state; };
/// Throws SimulationError if there is no equilibrium, or if what acts on the network depends on how it moves.
SteadyBlocks steady_blocks(const Network& network, const BlockSignals& blocks);

}  // namespace rheonet
