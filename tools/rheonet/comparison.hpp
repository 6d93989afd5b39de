#pragma once

#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/scene.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet::tool {

/// What is compared: for each scene the path of its record.
using Pairing = std::vector<std::string>;

/// Scenes that cannot be compared: `what()` says why, for a person to read.
struct NotComparable : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Throws NotComparable unless all scenes have the same domain and their runs begin together.
void check_comparable(const std::vector<Scene>& scenes);

/// Gives all scenes the output times of the first, as far as the shortest run goes.
void to_one_time_base(std::vector<Scene>& scenes);

/// Where among a scene's records each path is.
using Columns = std::unordered_map<std::string, std::size_t>;
Columns record_columns(const Scene& scene);

/// The paths that all scenes record, in the order of the first; `columns` are those of each.
std::vector<Pairing> shared_records(const Scene& first, const std::vector<Columns>& columns);

/// Scenes, run on one time base, and how far each is from the first.
struct Compared {
  std::vector<std::string> files;
  std::vector<Scene> scenes;
  std::vector<Columns> columns;  ///< of each scene
  std::vector<Sources> sources;
  std::vector<Pairing> pairings;
  std::vector<Trajectory> trajectories;
  std::vector<std::vector<Difference>> differences;  ///< of each scene but the first, for each pairing

  /// Adds a scene that has been read.
  void add(std::string file, Scene scene, Sources from);
};

/// Pairs the records that all scenes share, unless `pairings` are given, and puts the scenes on one time base. Throws
/// NotComparable, also if records of a pair are different quantities. `pairings` stay empty if the scenes share none.
void prepare(Compared& compared);

/// Simulates all scenes and takes the differences. Throws SimulationError; as many `trajectories` are there then as scenes were simulated.
void simulate(Compared& compared, const RunSettings& settings);

}  // namespace rheonet::tool
