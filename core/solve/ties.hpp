#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// What only constant forces hold on to must be in balance, and stay so: throws SimulationError where it is not, in the
/// state last viewed, after `overloaded`, which may throw one that tells better. Returns in words, for each such tie, that its motion is left open.
std::vector<std::string> check_ties(const Dae& dae, double t, const std::function<void()>& overloaded);

}  // namespace rheonet
