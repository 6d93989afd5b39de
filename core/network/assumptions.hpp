#pragma once

#include "core/network/network.hpp"

namespace rheonet {

// What is taken for granted of a scene, told in the notes of its network.

/// Times that are left out because they are shorter than what tells the times of the run apart.
void tell_lost_times(Network& network);
/// The effects that the scene leaves out.
void tell_left_out(Network& network);
/// Values that the netlist gives and that mean nothing, at the limits of the laws that they are given to.
void tell_meaningless(Network& network);

}  // namespace rheonet
