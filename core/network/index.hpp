#pragma once

#include <cstddef>

namespace rheonet {

/// Nodes, branches and elements are numbered by int, containers by std::size_t.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace rheonet
