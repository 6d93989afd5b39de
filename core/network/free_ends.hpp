#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/limits.hpp"

namespace rheonet {

/// Subnetworks that hang on a single node: nodes without mass, motion, applied force or start values, which elements join to
/// the rest of the network through that node alone. Their elements carry no force, so that they move with the node.
struct FreeEnds {
  std::vector<NodeId> on;     ///< of each node of the scene: the node on which it hangs; itself if it does not hang
  std::vector<int> elements;  ///< of the scene: those that carry no force for this reason
};

/// The free ends of a scene, without those that may begin displaced or under force: these may first have to come to rest.
/// `laws`: of each element, at the limits of its parameters.
FreeEnds find_free_ends(const Scene& scene, const std::vector<Reduced>& laws);

/// A note for each node on which several elements hang.
std::vector<std::string> tell_free_ends(const Scene& scene, const FreeEnds& ends);

}  // namespace rheonet
