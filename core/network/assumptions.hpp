#pragma once

#include "core/network/network.hpp"

namespace rheonet {

// Each function adds to the notes of the network what the simulation assumes about the scene.

/// Times that are set to 0 because they are below the resolution of time in this run (time_roundoff.hpp).
void tell_lost_times(Network& network);
/// The effects that the scene leaves out.
void tell_left_out(Network& network);
/// Values given in the netlist that have no effect at the limits of the laws to which they belong. `laws` has one of each element.
void tell_meaningless(Network& network, const std::vector<Reduced>& laws);

}  // namespace rheonet
