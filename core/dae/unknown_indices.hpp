#pragma once

#include <vector>

#include "core/dae/positions.hpp"

namespace rheonet {

/// The index into y of each unknown; -1 where a quantity is none.
struct UnknownIndices {
  std::vector<int> velocity;    ///< of each node
  std::vector<int> deflection;  ///< of each deflection branch
  std::vector<int> force;       ///< of each rate branch
  std::vector<int> position;    ///< of each node: of its distance from its parent (see Positions)
  std::vector<int> block;       ///< of each state of a block
  int deflections_begin = 0, deflections_end = 0;  ///< Deflections are numbered one after the other.
  int count = 0;                ///< Number of unknowns.
  /// For each node, the row in which the forces on its whole group balance: the row of the branch that leads to the node.
  std::vector<int> group_balance;
};

/// Numbers the unknowns of a network. `block_states`: the number of states that blocks have.
UnknownIndices number_unknowns(const Network& network, const Structure& structure, const Positions& positions, std::size_t block_states);

}  // namespace rheonet
