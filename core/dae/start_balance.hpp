#pragma once

#include <string>
#include <vector>

#include "core/dae/state.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// At a massless node that only springs and laws with a memory hold, their forces must balance from the start. An
/// initial force that is given there (`f0`, of a spring also by `d0`) is kept: those that are not given follow from it,
/// in series one from the other, or the node goes where springs make up for it. Where no initial force is given nothing
/// is done: the first instant finds the balance.
///
/// `fixed` marks nodes whose position the user has given. Changes the state, and the memories of laws. Throws
/// SimulationError where all that is given at a node does not balance. Returns in words what was chosen.
std::vector<std::string> balance_start(const Network& network, const Structure& classified, std::vector<char> fixed,
                                       State& state);

}  // namespace rheonet
