#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Checks the balance of node groups that only constant forces hold (ties), in the state last viewed. Where the forces do not
/// balance, or the load changes, throws SimulationError, after a call of `overloaded`, which may throw a better one. Returns
/// a note for each tie: its motion is undetermined.
std::vector<std::string> check_ties(const Dae& dae, double t, const std::function<void()>& overloaded);

}  // namespace rheonet
