#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Checks that groups of nodes that only constant forces hold balance in the state last viewed, and keep balancing. If
/// not, throws SimulationError, after `overloaded`, which may throw a better one. Returns a note on each: its motion is
/// open.
std::vector<std::string> check_indeterminate_groups(const Dae& dae, double t, const std::function<void()>& overloaded);

}  // namespace rheonet
