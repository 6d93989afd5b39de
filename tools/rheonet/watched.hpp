#pragma once

#include <functional>

#include "core/netlist/read.hpp"

namespace rheonet::tool {

/// Does what may take long, with a bar on the terminal that it moves: it is given what tells how far it has come, 0 to 1. False
/// if it throws SimulationError, which has then been reported.
bool do_watched(const Sources& sources, const std::function<void(const std::function<void(double)>&)>& work);

}  // namespace rheonet::tool
