#pragma once

#include <string>

#include "core/dae/convex.hpp"
#include "core/dae/event_network.hpp"

namespace rheonet {

/// Throws SimulationError if rigid links join nodes that move at different velocities.
void refuse_torn_links(const EventNetwork& net, double t);

/// Where a law forbids a motion one way (a freewheel), prescribed motions may not demand it: no branch could open. Throws SimulationError
/// if they do in the solution of a mode selection.
void refuse_blocked_motions(const EventNetwork& net, double t, const ConvexNetwork& problem);

/// "node `a`, which motion `drive` moves at 1 m/s,", or "`ground`". `how`: " at 1 m/s".
std::string moved_node(const EventNetwork& net, NodeId node, const std::string& how);

}  // namespace rheonet
