#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace rheonet::test {

/// A random network of springs, dashpots and friction elements between the nodes `end` and `ground`, written twice.
struct RandomTree {
  std::string composed;  ///< as `[elements.tree]` with series and parallel
  std::string wired;     ///< as lines of `[elements]` between nodes, in the order of the tree
  std::string shuffled;  ///< the same lines in another order
  /// Paths of the same element or group in the two: ("tree.spring3", "e07").
  std::vector<std::pair<std::string, std::string>> elements;
};

/// The same tree for the same seed. About half of the trees name their elements, the others leave it to the simulator.
RandomTree random_tree(std::uint64_t seed);

}  // namespace rheonet::test
