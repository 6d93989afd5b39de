#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Groups of nodes that have one velocity in steady motion. A node represents each: one whose velocity is given if there is one.
class VelocityGroups {
 public:
  /// Each node is a group at first. The structure must outlive this.
  explicit VelocityGroups(const Structure& structure) : structure_(structure), leader_(structure.kind.size()) {
    std::iota(leader_.begin(), leader_.end(), 0);
  }
  /// Makes a group of each set.
  void take(DisjointSets& sets);
  /// The velocity of this node is given because nothing else determines it.
  void pin(NodeId node) { pinned_.push_back(node); }
  /// The velocity of this node is given.
  bool held(NodeId node) const {
    return structure_.kind[at(node)] == Kind::known || std::find(pinned_.begin(), pinned_.end(), node) != pinned_.end();
  }
  /// The node that represents all that move with this one.
  NodeId leader(NodeId node) const { return leader_[at(node)]; }
  /// Its place in a problem.
  int slot(NodeId node) const { return structure_.rank[at(leader(node))]; }
  bool together(const Branch& b) const { return leader(b.a) == leader(b.b); }

 private:
  const Structure& structure_;
  std::vector<NodeId> leader_, pinned_;
};

}  // namespace rheonet
