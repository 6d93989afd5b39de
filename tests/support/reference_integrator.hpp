#pragma once

#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// The solution of an independent integrator: fixed steps of implicit Euler (reference_step.hpp), extrapolated from two step sizes. The error
/// is the change by a further halving of the step. It shares no code with the simulator except the reader of netlists and its signals.
struct ReferenceSolution {
  struct Column {
    std::vector<double> value;  ///< at each output time
    std::vector<double> coarse; ///< the same from the two longest steps
    std::vector<double> error;  ///< estimated; infinite where the laws leave the value open, or a turn lies too near
    double scale = 0;           ///< largest magnitude in the rows
  };
  std::vector<double> time;     ///< The output times up to `end` [s].
  std::vector<Column> columns;  ///< One for each record of the scene.
  double end = 0;               ///< Stop time, or the time at which the forces could no longer be balanced [s].
  bool complete = true;         ///< False: nothing resists the applied force at `end`.
  double fork = 0;              ///< Time from which the laws do not determine the motion [s]; infinite if they always do.
  int steps = 0;                ///< Number of steps of the finest run.
};

struct ReferenceSettings {
  int base_steps = 400;       ///< of the coarsest run
  int halvings = 6;           ///< at most; at least 2
  double target = 1e-4;       ///< of a record's scale: halving stops when every row is estimated to be as good
};

ReferenceSolution integrate_reference(const Scene& scene, Declarations declarations,
                                      const ReferenceSettings& settings = {});

}  // namespace rheonet::test
