#pragma once

#include <string>
#include <vector>

#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Gives the springs in series with sliders their forces at the start, with the network's nodes at `position`: the node
/// in the middle of a pair is at 0 unless the netlist says otherwise, and slides at once where that is more than its
/// slider holds. Returns in words what was chosen.
std::vector<std::string> start_pairs(const Network& network, const std::vector<double>& position);

/// The nodes in the middle follow a state that has been found from the start values.
void follow_pairs(const Network& network, const State& state);

}  // namespace rheonet
