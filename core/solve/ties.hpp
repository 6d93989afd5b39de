#pragma once

#include <string>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// What only constant forces hold on to must be in balance, and stay so: throws SimulationError where it is not, in the
/// state last viewed. Returns in words, for each such tie, that its motion is left open.
std::vector<std::string> check_ties(const Dae& dae, double t);

}  // namespace rheonet
