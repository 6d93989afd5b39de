#pragma once

#include <optional>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// The largest force at a node that the elements of a scene can carry: the minimum cut between the node and all nodes with inertia or a
/// prescribed motion. Friction carries its Coulomb force, any other element an arbitrary force (max-flow min-cut: Ford and Fulkerson 1956;
/// limit load of plastic frames: Drucker, Prager and Greenberg 1952).
struct Capacity {
  double sliding;   ///< Minimum cut with every slider at `coulomb`: loads up to here are certainly carried [N].
  double sticking;  ///< The same with every slider at `breakaway`: loads beyond are certainly not carried [N].
};
/// The capacity at time t, for a force in the positive (1) or the negative direction (-1). Absent without an applied force.
std::optional<Capacity> capacity_of(const Scene& scene, double t, int direction = 1);

/// The first time within the run at which the force applied exceeds `factor` times its capacity; absent if it never does.
std::optional<double> first_above(const Scene& scene, double Capacity::* level, double factor);

}  // namespace rheonet::test
