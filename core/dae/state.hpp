#pragma once

#include <vector>

namespace rheonet {

/// The state of a network independent of its modes: it passes from the equations of one mode to those of the next.
struct State {
  std::vector<double> velocity;  ///< For each node [m/s]; a guess at massless nodes.
  std::vector<double> p;         ///< Deflection of each deflection branch [m].
  std::vector<double> position;  ///< For each node [m]; updated where it is requested.
  std::vector<double> train_force;  ///< For each train [N]: the bounds of its losses depend on it.
  std::vector<double> blocks;    ///< States of the blocks that have one [unit of the output].
  std::vector<double> offset;    ///< Displacement less deflection of each deflection branch that does not creep [m]; changes at
                                 ///< reversals only.
};

/// A deflection branch in a Filippov sliding mode: both directions hold it at rest.
struct SlidingMode {
  int branch;
  int lean;  ///< Side of the branch to which a slider in parallel is at its bound: -1, 1, or 0 if there is none.
};

}  // namespace rheonet
