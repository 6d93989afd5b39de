#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// The share of a scene that disturbances can reach before the stop. Beyond lie masses at rest, joined by linear dashpots
/// and unloaded linear springs alone: motion propagates through them from one mass to the next.
///
/// The motion d elements away from the rest of the network is bounded. Let k and c be the stiffnesses and dampings at a mass
/// m, towards masses nearer (+), equally far (0) and farther (-) and to ground. For any w > 1 let
///
///     a = max over masses of  (c+ (w - 1) + c- (1/w - 1) - c_ground)/m
///     b = max over masses of  (k+ (w + 1) + k- (1/w + 1) + 2 k0 + k_ground)/m,      r^2 = a r + b
///
/// Then w^d times any velocity, and r w^d times any displacement, grow no faster than exp(r t), because the largest of these
/// obey v' <= a v + b x and x' <= v. With w^d = exp(r (stop - start))/e, no mass beyond moves faster than the share e of the
/// largest velocity of the rest (or of r times its largest displacement), and its reaction is a share e^2. The w with the
/// smallest d is used.
struct InfluenceCone {
  std::vector<char> node, element;  ///< of each node and element of the scene: disturbances can reach it
  std::size_t beyond = 0;           ///< number of elements out of reach
  int farthest = 0;                 ///< masses at a larger distance, in elements, are out of reach
};

/// Absent if hardly anything lies beyond, or if the start is to be an equilibrium or steady motion.
std::optional<InfluenceCone> influence_cone(const Scene& scene);

}  // namespace rheonet
