#pragma once

#include <atomic>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/run.hpp"

namespace rheonet::tool {

/// What is compared: for each scene the path of its record.
using Pairing = std::vector<std::string>;

/// A run, kept.
struct Course {
  std::vector<double> times;
  std::vector<std::vector<double>> rows;  ///< of each time, the scene's records
  Summary summary;
};

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

/// Why scenes cannot be compared; "" if they can: the same domain, and runs that begin together and overlap.
std::string obstacle(const std::vector<Scene>& scenes);

/// Gives all scenes the output times of the first, as far as the shortest run goes.
void to_one_time_base(std::vector<Scene>& scenes);

/// Where among a scene's records each path is.
using Columns = std::unordered_map<std::string, std::size_t>;
Columns columns_of(const Scene& scene);

/// The paths that all scenes record, in the order of the first; `columns` are those of each.
std::vector<Pairing> shared_records(const Scene& first, const std::vector<Columns>& columns);

/// Simulates. Throws SimulationError, also when `interrupted` becomes true.
Course run_to_memory(const Scene& scene, const std::atomic<bool>& interrupted);

Difference difference(const Course& first, std::size_t first_column, const Course& second, std::size_t second_column);

}  // namespace rheonet::tool
