#include "core/result/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/result/simulation_method.hpp"

namespace rheonet {

Trajectory run_to_memory(const Scene& scene, RunSettings settings) {
  const SimulationMethod usual{.order = settings.order};
  return run_to_memory_by(usual, scene, std::move(settings));
}

Trajectory run_to_memory_by(const SimulationMethod& method, const Scene& scene, RunSettings settings) {
  Trajectory trajectory;
  settings.row = [&trajectory, also = std::move(settings.row)](double time, const std::vector<double>& values) {
    if (also) also(time, values);
    trajectory.times.push_back(time);
    trajectory.rows.push_back(values);
  };
  trajectory.summary = run_by(method, scene, settings);
  return trajectory;
}

Difference difference(const Trajectory& first, std::size_t first_column, const Trajectory& second, std::size_t second_column) {
  Difference result;
  double squares = 0;
  const std::size_t rows = std::min(first.rows.size(), second.rows.size());
  for (std::size_t row = 0; row < rows; ++row) {
    const double a = first.rows[row][first_column], b = second.rows[row][second_column];
    const double apart = std::abs(b - a);
    squares += apart * apart;
    result.scale = std::max({result.scale, std::abs(a), std::abs(b)});
    if (row > 0 && apart <= result.largest) continue;
    result.largest = apart;
    result.time = first.times[row];
    result.first = a;
    result.second = b;
  }
  result.rms = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(rows, 1)));
  return result;
}

}  // namespace rheonet
