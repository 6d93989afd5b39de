#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rheonet {

/// Nodes, branches and elements are numbered by int, containers by std::size_t.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Linear search, for short lists.
inline bool contains(const std::vector<int>& list, int i) { return std::find(list.begin(), list.end(), i) != list.end(); }

}  // namespace rheonet
