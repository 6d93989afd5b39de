#pragma once

#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// What an independent integrator finds: fixed steps of implicit Euler (reference_step.hpp), extrapolated from two step
/// lengths; the error is what a further halving of the step changes. It shares no code with the simulator but the reader
/// of netlists and its signals.
struct ReferenceSolution {
  struct Column {
    std::vector<double> value;  ///< at each output time
    std::vector<double> coarse; ///< the same from the two longest steps
    std::vector<double> error;  ///< estimated; infinite where the laws leave the value open, or a turn lies too near
    double scale = 0;           ///< largest magnitude in the rows
  };
  std::vector<double> time;     ///< the output times up to `end`
  std::vector<Column> columns;  ///< one for each record of the scene
  double end = 0;               ///< s: the stop, or where the forces could no longer be balanced
  bool complete = true;         ///< false: nothing resists what is applied at `end`
  double fork = 0;              ///< s: the laws leave open what comes after; infinite if they decide all
  int steps = 0;                ///< of the finest run
};

struct ReferenceSettings {
  int base_steps = 400;       ///< of the coarsest run
  int halvings = 6;           ///< at most; at least 2
  double target = 1e-4;       ///< of a record's scale: halving stops when every row is estimated to be as good
};

ReferenceSolution integrate_reference(const Scene& scene, Declarations declarations,
                                      const ReferenceSettings& settings = {});

}  // namespace rheonet::test
