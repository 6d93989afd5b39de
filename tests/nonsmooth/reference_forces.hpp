#pragma once

#include <optional>
#include <vector>

#include "core/nonsmooth/boxed_forces.hpp"

namespace rheonet::test {

/// The problem of BoxedForces, for a few branches, by another method: guesses which forces are at which bound, solves the balance
/// densely with 64 bits of mantissa, and takes the first guess that meets every condition. The problem is strictly convex, so that
/// there is one answer. Empty where a set of nodes is overloaded, as all sets show, one by one.
struct ReferenceForces {
  std::vector<double> force;
  int active = 0;  ///< forces at their bounds
};
std::optional<ReferenceForces> reference_forces(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& load);

/// The largest excess of the load of a set of nodes over what the branches that leave the set can carry.
double largest_excess(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& load);

}  // namespace rheonet::test
