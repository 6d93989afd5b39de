#pragma once

#include <cmath>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"

namespace rheonet {

/// Clusters of nodes that move as one: each with a head, its heaviest node, and a column among the unknowns unless that node is fixed.
class NodeClusters {
 public:
  explicit NodeClusters(int nodes) : cluster_(at(nodes), 0) {}

  /// Makes a cluster of each set. `weight(node)`: infinite for a fixed node.
  template <class Weight>
  void merge(DisjointSets& sets, Weight weight) {
    const std::size_t nodes = cluster_.size();
    std::vector<double> heaviest(nodes, -1);
    head_.assign(nodes, -1);
    for (std::size_t k = 0; k < nodes; ++k) {
      const int set = cluster_[k] = sets.find(static_cast<int>(k));
      const double own = weight(k);
      if (own > heaviest[at(set)]) {
        heaviest[at(set)] = own;
        head_[at(set)] = static_cast<int>(k);
      }
    }
    column_.assign(nodes, -1);
    columns_ = 0;
    for (std::size_t k = 0; k < nodes; ++k) {
      int& column = column_[at(cluster_[k])];
      if (std::isfinite(heaviest[at(cluster_[k])]) && column < 0) column = columns_++;
    }
  }
  /// The cluster of a node.
  std::size_t of(int node) const { return at(cluster_[at(node)]); }
  bool joined(int a, int b) const { return cluster_[at(a)] == cluster_[at(b)]; }
  int head(int node) const { return head_[of(node)]; }
  /// Column of a node's cluster; -1 if it holds a fixed node.
  int column(int node) const { return column_[of(node)]; }
  int columns() const { return columns_; }

 private:
  std::vector<int> cluster_;  ///< For each node.
  std::vector<int> head_, column_;  ///< For each cluster.
  int columns_ = 0;
};

}  // namespace rheonet
