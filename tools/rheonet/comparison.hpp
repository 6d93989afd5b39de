#pragma once

#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/scene.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet::tool {

/// Records that are compared with each other: a path for each scene.
using Pairing = std::vector<std::string>;

/// The scenes cannot be compared; `what()` has the reason.
struct NotComparable : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Throws NotComparable unless all scenes have the same domain and their runs begin together.
void check_comparable(const std::vector<Scene>& scenes);

/// Gives all scenes the output times of the first, as far as the shortest run goes.
void to_one_time_base(std::vector<Scene>& scenes);

/// The position of each path among a scene's records.
using Columns = std::unordered_map<std::string, std::size_t>;
Columns record_columns(const Scene& scene);

/// The paths that all scenes record, in the order of the first; `columns` has the columns of each scene.
std::vector<Pairing> shared_records(const Scene& first, const std::vector<Columns>& columns);

/// Scenes, run on one time base, and the difference of each from the first.
struct Compared {
  std::vector<std::string> files;
  std::vector<Scene> scenes;
  std::vector<Columns> columns;  ///< For each scene.
  std::vector<Sources> sources;
  std::vector<Pairing> pairings;
  std::vector<Trajectory> trajectories;
  std::vector<std::vector<Difference>> differences;  ///< For each scene but the first, for each pairing.

  /// Adds a scene that has been read.
  void add(std::string file, Scene scene, Sources from);
};

/// Pairs the records that all scenes share, unless `pairings` are given, and puts the scenes on one time base. Throws
/// NotComparable, also if the records of a pair are different quantities. `pairings` stays empty if the scenes share no record.
void prepare(Compared& compared);

/// Simulates all scenes and computes the differences. Throws SimulationError; `trajectories` then has those of the scenes that were
/// simulated.
void simulate(Compared& compared, const RunSettings& settings);

}  // namespace rheonet::tool
