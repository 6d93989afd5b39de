#pragma once

#include <vector>

#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// How the position of a node is found. It follows from the position of its parent through a deflection that is an unknown
/// anyway, x = x_parent + sign (p + offset), or along a slider, by the displacement at which it sticks. It may also follow from the equation
/// of a train whose other nodes are the parent and known ones: the sum of positions times factors is constant. Otherwise its distance from the parent is integrated, x = x_parent + y: that distance may be small where both move far. A node without neighbours
/// has ground as its parent.
struct Position {
  double sign = 1;
  int branch = -1, slider = -1;
  int train_equation = -1;  ///< index into Structure::train_equations
  NodeId parent = ground;
  bool integrated = false;
};

struct Positions {
  std::vector<Position> of;            ///< each node
  std::vector<NodeId> integrated;   ///< in the order in which they were found
  std::vector<NodeId> order;        ///< those needed for positions, parents first
};

/// `needed[node]`: its position is requested.
Positions find_positions(const Network& network, const Structure& structure, const std::vector<char>& needed);

}  // namespace rheonet
