#pragma once

#include <vector>

#include "core/dae/event_network.hpp"

namespace rheonet {

/// Sums of the forces at nodes.
struct NodalForces {
  /// For each node: the sum of the forces, the sum of their magnitudes, and their error due to the round-off of velocities [N].
  std::vector<double> sum, magnitude, rounding;

  /// The force that is lacking for a balance at a node, where an imbalance up to `accepted` counts as one [N]; 0 within round-off.
  double lacking(std::size_t node, double accepted) const;
};

/// Forces under the inputs last evaluated, without inertia; `rates`: those of rate laws as well.
NodalForces nodal_forces(const EventNetwork& net, const State& state, const std::vector<double>& slider_force, bool rates);

/// Sums over the nodes that move as one at an event, at the node that represents them.
NodalForces together(const EventNetwork& net, const NodalForces& single);

/// Slope of a law times its deflection [N]: the force of the law has the round-off of this product.
double force_of_deflection(const DeflectionBatch& batch, std::size_t i, double p);

}  // namespace rheonet
