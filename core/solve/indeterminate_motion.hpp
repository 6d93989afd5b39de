#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Checks that ties (node groups that only constant forces hold) balance in the state last viewed, and keep balancing. If
/// not, throws SimulationError, after `overloaded`, which may throw a better one. Returns a note on each tie: its motion is
/// open.
std::vector<std::string> check_ties(const Dae& dae, double t, const std::function<void()>& overloaded);

}  // namespace rheonet
