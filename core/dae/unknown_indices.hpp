#pragma once

#include <vector>

namespace rheonet {

/// The index into y of each unknown; -1 where a quantity is none.
struct UnknownIndices {
  std::vector<int> velocity;    ///< of each node
  std::vector<int> deflection;  ///< of each deflection branch
  std::vector<int> force;       ///< of each rate branch
  std::vector<int> position;    ///< of each node: of its distance from its parent (see Positions)
  std::vector<int> block;       ///< of each state of a block
};

}  // namespace rheonet
