#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Sets of nodes, each of which moves as one, and what the trains between them leave free. A set can move until it is placed, or the
/// trains say how it moves with sets that are placed.
class FreeMotions {
 public:
  FreeMotions(const Network& network, DisjointSets& sets);

  void place(NodeId node) { placed_[at(sets_.find(node))] = 1; }
  bool free(NodeId node) const;
  /// A motion of the sets that are not placed, in which the free set of this node moves by 1: representatives of the sets that move,
  /// and by how much.
  std::vector<std::pair<NodeId, double>> motion(NodeId node) const;

 private:
  Eigen::MatrixXd motions(std::vector<NodeId>& moving) const;

  const Network& network_;
  DisjointSets& sets_;
  std::vector<char> placed_, geared_;  ///< of each representative
};

}  // namespace rheonet
