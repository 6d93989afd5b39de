#pragma once

#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// The rows of a run, in memory.
struct Trajectory {
  std::vector<double> times;
  std::vector<std::vector<double>> rows;  ///< of each time, values of the scene's records
  Summary summary;
};

/// Simulates. The `row` of the settings is called as well. Throws SimulationError.
Trajectory run_to_memory(const Scene& scene, RunSettings settings = {});

/// Difference of two records, SI.
struct Difference {
  double largest = 0;            ///< largest magnitude
  double time = 0;               ///< time of the largest difference [s]
  double first = 0, second = 0;  ///< the two values at that time
  double rms = 0;                ///< root mean square
  double scale = 0;              ///< largest magnitude of either record, the reference of relative differences

  double relative() const { return scale > 0 ? largest / scale : 0; }
  double relative_rms() const { return scale > 0 ? rms / scale : 0; }
};

Difference difference(const Trajectory& first, std::size_t first_column, const Trajectory& second, std::size_t second_column);

}  // namespace rheonet
