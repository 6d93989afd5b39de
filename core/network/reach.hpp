#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// What of a scene is near enough to all that moves, starts or is asked for to be reached before the stop. Beyond lie masses at
/// rest between linear springs free of force and linear dashpots alone: motion comes to them from one to the next.
///
/// Their motion d elements away from the rest of the network is bounded. With k and c the stiffnesses and dampings at a mass m,
/// those towards masses nearer by (+), as far (0) and farther (-) and those to ground, let for any w > 1
///
///     a = max over masses of  (c+ (w - 1) + c- (1/w - 1) - c_ground)/m
///     b = max over masses of  (k+ (w + 1) + k- (1/w + 1) + 2 k0 + k_ground)/m,      r^2 = a r + b
///
/// Then w^d times any of their velocities, and r w^d times any displacement, grow no faster than exp(r t): the largest of them
/// obey v' <= a v + b x and x' <= v. So with w^d = exp(r (stop - start))/e no mass beyond moves faster than the share e of what
/// the rest does at the most (of its velocities, and of r times its displacements); and what it would answer is that share of a
/// share. The w is taken that gives the least d.
struct Reach {
  std::vector<char> node, element;  ///< of each of the scene's: it is near enough
  std::size_t beyond = 0;           ///< how many elements are not
  int farthest = 0;                 ///< masses farther away than so many elements are not
};

/// Absent where hardly anything lies beyond, or where forces are to be in balance at the start.
std::optional<Reach> reach_of(const Scene& scene);

}  // namespace rheonet
