#pragma once

#include <stdexcept>
#include <string>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/run.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet::bench {

/// Reads a netlist of the benchmark. Throws std::runtime_error if it is refused.
inline Scene read(const std::string& text, double accuracy = 0) {
  ReadOptions options;
  if (accuracy > 0) options.accuracy = accuracy;
  ReadResult result = read_scene_text(text, "benchmark", {}, declarations(), options);
  if (!result.scene) throw std::runtime_error(format(result.diagnostics.front(), result.sources));
  return std::move(*result.scene);
}

/// The only record of a scene at its output times.
inline std::vector<double> values(const Scene& scene) {
  std::vector<double> column;
  for (const auto& row : run_to_memory(scene).rows) column.push_back(row.front());
  return column;
}

}  // namespace rheonet::bench
