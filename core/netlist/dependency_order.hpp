#pragma once

#include <cstddef>
#include <vector>

namespace rheonet {

/// A topological order of items that use each other, and the cycles that prevent one.
struct DependencyOrder {
  std::vector<std::size_t> order;  ///< each item after all that it uses; without items that are on a cycle or use one
  std::vector<std::vector<std::size_t>> cycles;  ///< each lists the items on the cycle; the first is not repeated at the end
};

/// Sorts items topologically; `uses[i]` lists the items that item i uses. Takes linear time and does not recurse, so that
/// long chains cannot exhaust the stack.
DependencyOrder dependency_order(const std::vector<std::vector<std::size_t>>& uses);

}  // namespace rheonet
