#pragma once

#include <vector>

namespace rheonet {

/// A deflection is rounded less often than a sum of forces is. Where a small force comes of a large deflection, so much of what
/// the slope makes of that counts as a force that is rounded.
constexpr double deflection_share = 0.1;

/// Where a network is, whatever its modes: what goes from the equations of one mode to those of the next.
struct State {
  std::vector<double> velocity;  ///< of each node [m/s]; of massless nodes a guess
  std::vector<double> p;         ///< deflection of each deflection branch [m]
  std::vector<double> position;  ///< of each node [m]; kept up for those that are asked for
  std::vector<double> blocks;    ///< the states of those blocks that have one [unit of the output]
  std::vector<double> offset;    ///< displacement less deflection of each deflection branch that does not creep [m]; changes at
                                 ///< reversals only
};

/// A deflection branch that both directions hold at rest.
struct Standing {
  int branch;
  int lean;  ///< side of the branch to which a slider beside it is at its bound: -1, 1, or 0 if there is none
};

}  // namespace rheonet
