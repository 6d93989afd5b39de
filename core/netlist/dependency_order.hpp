#pragma once

#include <cstddef>
#include <vector>

namespace rheonet {

/// What must come before what.
struct DependencyOrder {
  std::vector<std::size_t> order;  ///< each after all that it uses; those on or above a cycle are left out
  std::vector<std::vector<std::size_t>> cycles;  ///< each as the list of those on it, the first not repeated at the end
};

/// `uses[i]` are those that i uses. Takes time in proportion to their number, and no stack, however long the chains.
DependencyOrder dependency_order(const std::vector<std::vector<std::size_t>>& uses);

}  // namespace rheonet
