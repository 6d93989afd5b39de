#pragma once

#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// A run, kept.
struct Course {
  std::vector<double> times;
  std::vector<std::vector<double>> rows;  ///< of each time, the scene's records
  Summary summary;
};

/// Simulates. Rows also go to the `row` of the settings as they come. Throws SimulationError.
Course run_to_memory(const Scene& scene, RunSettings settings = {});

/// How far the course of a record is from that of another, SI.
struct Difference {
  double largest = 0;            ///< magnitude
  double time = 0;               ///< when it is that [s]
  double first = 0, second = 0;  ///< the two values then
  double rms = 0;                ///< root of the mean of squares
  double scale = 0;              ///< largest magnitude of either: what relative differences are relative to

  double relative() const { return scale > 0 ? largest / scale : 0; }
  double relative_rms() const { return scale > 0 ? rms / scale : 0; }
};

Difference difference(const Course& first, std::size_t first_column, const Course& second, std::size_t second_column);

}  // namespace rheonet
