#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace rheonet {

/// Union-find over 0 .. n-1 (nodes, say): disjoint sets, each with one member as its representative. Uses path halving.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : leader_(n) { std::iota(leader_.begin(), leader_.end(), 0); }
  int find(int i) {
    while (up(i) != i) i = up(i) = up(up(i));
    return i;
  }
  /// Unites the sets of i and j under the representative of j.
  void join(int i, int j) { up(find(i)) = find(j); }

 private:
  int& up(int i) { return leader_[static_cast<std::size_t>(i)]; }
  std::vector<int> leader_;
};

}  // namespace rheonet
