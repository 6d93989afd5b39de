#pragma once

#include "core/network/structure.hpp"

namespace rheonet {

/// Finds the trees of `structure` (see there), whose nodes are sorted into groups already: gives each group its tree branch
/// or its tie, and numbers the groups by depth. Throws SimulationError where nothing determines the motion of a node.
void grow_forest(const Network& network, Structure& structure);

/// -(v_a - v_b), expressed along the trees from both nodes up to where their paths meet, plus the flow of `branch` if it is
/// not -1.
Structure::Loop express(const Structure& structure, NodeId a, NodeId b, int branch);

}  // namespace rheonet
