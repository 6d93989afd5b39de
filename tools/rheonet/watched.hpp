#pragma once

#include <functional>

#include "core/netlist/read.hpp"

namespace rheonet::tool {

/// Runs `work` with a progress bar on the terminal. `work` gets a function to call with the fraction done, 0 to 1. Returns false if `work`
/// throws SimulationError, which is then reported.
bool do_watched(const Sources& sources, const std::function<void(const std::function<void(double)>&)>& work);

}  // namespace rheonet::tool
