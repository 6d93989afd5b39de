#include "core/dae/velocity_groups.hpp"

namespace rheonet {

void VelocityGroups::take(DisjointSets& sets) {
  std::vector<NodeId> first(leader_.size(), -1);
  for (const bool given : {true, false}) {
    for (std::size_t n = 0; n < leader_.size(); ++n) {
      NodeId& leader = first[at(sets.find(static_cast<NodeId>(n)))];
      if (leader < 0 && held(static_cast<NodeId>(n)) == given) leader = static_cast<NodeId>(n);
    }
  }
  for (std::size_t n = 0; n < leader_.size(); ++n) leader_[n] = first[at(sets.find(static_cast<NodeId>(n)))];
}

}  // namespace rheonet
