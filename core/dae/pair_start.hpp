#pragma once

#include <string>
#include <vector>

#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Gives the springs in series with sliders their initial forces, with the network's nodes at `position`. The middle node of a
/// pair starts at 0 unless the netlist places it. It slides at once if the force there exceeds the bound of its slider. Returns
/// in words which values were chosen.
std::vector<std::string> start_pairs(const Network& network, const std::vector<double>& position);

/// Moves the middle nodes of pairs along with a state that was found from the start values.
void follow_pairs(const Network& network, const State& state);

}  // namespace rheonet
