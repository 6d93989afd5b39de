#pragma once

#include "core/network/structure.hpp"

namespace rheonet {

/// Finds the spanning forest of `structure` (see there), whose nodes are already sorted into groups: gives each group its
/// tree branch or set of indeterminate groups, and numbers the groups by depth. Throws SimulationError if nothing determines the motion of a node.
void grow_forest(const Network& network, Structure& structure);

/// Expresses -(v_a - v_b) along the trees, from both nodes up to where their paths meet. Adds the flow of `branch` unless it
/// is -1.
Structure::Loop express(const Structure& structure, NodeId a, NodeId b, int branch);

}  // namespace rheonet
