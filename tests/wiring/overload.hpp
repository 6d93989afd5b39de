#pragma once

#include <optional>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// Whether the elements of a scene can carry the force that is applied at a node, by the least cut between that node and
/// what has inertia or is held: friction carries its Coulomb force, all else any force (max-flow min-cut: Ford and
/// Fulkerson 1956; limit load of plastic frames: Drucker, Prager and Greenberg 1952).
struct Capacity {
  double sliding;   ///< least cut [N] with every slider at `coulomb`: up to there the load is certainly carried
  double sticking;  ///< with every slider at `breakaway`: beyond, it is certainly not
};
/// At time t, for a force in the positive (1) or the negative direction (-1). Absent without an applied force.
std::optional<Capacity> capacity_of(const Scene& scene, double t, int direction = 1);

/// The first time within the run at which the force applied exceeds `factor` times its capacity; absent if it never does.
std::optional<double> first_above(const Scene& scene, double Capacity::* level, double factor);

}  // namespace rheonet::test
