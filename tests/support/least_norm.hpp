#pragma once

#include <vector>

#include "core/nonsmooth/boxed_forces.hpp"

namespace rheonet::test {

/// Whether forces have the least norm of all forces in their boxes with the same sums at the nodes (node -1 may have any sum). They
/// do if there are potentials phi: phi_a - phi_b <= f where f can grow, and >= f where f can fall, to `rounding` [N]. The algorithm
/// of Bellman and Ford finds the potentials.
bool of_least_norm(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& force, double rounding);

}  // namespace rheonet::test
