#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace rheonet {

/// Disjoint sets over 0 .. n-1 (nodes, say), each with a member that speaks for it. Paths are halved as they are walked.
class Sets {
 public:
  explicit Sets(std::size_t n) : leader_(n) { std::iota(leader_.begin(), leader_.end(), 0); }
  int find(int i) {
    while (up(i) != i) i = up(i) = up(up(i));
    return i;
  }
  /// The one that speaks for j speaks for both from there on.
  void join(int i, int j) { up(find(i)) = find(j); }

 private:
  int& up(int i) { return leader_[static_cast<std::size_t>(i)]; }
  std::vector<int> leader_;
};

}  // namespace rheonet
