#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/limits.hpp"

namespace rheonet {

/// What hangs on one node alone: nodes without mass, drive or start values of their own that nothing but that node joins to
/// the rest of the network, over one element or many. No force goes through, so that they move with it.
struct FreeEnds {
  std::vector<NodeId> on;     ///< of each node of the scene: the one that it hangs on; itself for all others
  std::vector<int> elements;  ///< of the scene: those that carry no force for it
};

/// The free ends of a scene. Where something begins displaced or under a force there are none: what hangs there may have to
/// come to rest first. `laws`: of each element, at the limits of its parameters.
FreeEnds find_free_ends(const Scene& scene, const std::vector<Reduced>& laws);

/// For each node that several elements hang on, what there is to tell.
std::vector<std::string> tell_free_ends(const Scene& scene, const FreeEnds& ends);

}  // namespace rheonet
