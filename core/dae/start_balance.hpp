#pragma once

#include <string>
#include <vector>

#include "core/dae/state.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// At a massless node that only springs and laws with a memory hold, their forces must balance from the start. An initial force
/// that is given there (`f0`, for a spring also by `d0`) is kept. The forces that are not given follow from it, in series one
/// from the other, or the node moves to where springs balance it. If no initial force is given, nothing is done: the first
/// event finds the balance.
///
/// `fixed` marks nodes whose position the user has given. Changes the state, and the memories of laws. Throws SimulationError
/// if the given values at a node do not balance. Returns in words which values were chosen.
std::vector<std::string> balance_start(const Network& network, const Structure& classified, std::vector<char> fixed,
                                       State& state);

}  // namespace rheonet
