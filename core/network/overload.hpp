#pragma once

#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// Refuses what is applied to these nodes from the time t on: the elements of the scene that lead away from there have come
/// to the largest force that they can take. Throws SimulationError.
[[noreturn]] void report_overload(const Network& network, double t, const std::vector<NodeId>& nodes,
                                  const std::vector<int>& elements);

/// Where rounding hides which friction slips under its forces: throws SimulationError with `what` ("at t = 1 s", say), the names
/// of all that might, and what would mend it.
[[noreturn]] void report_undecided(const Network& network, const std::string& what);

}  // namespace rheonet
