#pragma once

#include <cstddef>
#include <vector>

namespace rheonet {

/// A topological order of items that use each other, and the cycles that prevent one.
struct DependencyOrder {
  std::vector<std::size_t> order;  ///< each item after all items that it uses; items on a cycle, or using one on a cycle,
                                   ///< are left out
  std::vector<std::vector<std::size_t>> cycles;  ///< each lists the items on the cycle; the first is not repeated at the end
};

/// Sorts items topologically; `uses[i]` lists the items that item i uses. Takes linear time and does not recurse, so that
/// long chains cannot exhaust the stack.
DependencyOrder dependency_order(const std::vector<std::vector<std::size_t>>& uses);

}  // namespace rheonet
