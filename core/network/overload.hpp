#pragma once

#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// Refuses what is applied to these nodes from the time t on: the elements of the scene that lead away from there have come
/// to the largest force that they can take. Throws SimulationError.
[[noreturn]] void report_overload(const Network& network, double t, const std::vector<NodeId>& nodes,
                                  const std::vector<int>& elements);

}  // namespace rheonet
