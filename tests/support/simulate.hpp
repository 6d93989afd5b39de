#pragma once

#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/run.hpp"

namespace rheonet::test {

/// The rows of a run, by column name; `time` is a column like the others.
struct RunTable {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> header;

  /// Fails the test if there is no such column.
  const std::vector<double>& operator[](const std::string& name) const;
  const std::vector<double>& time() const { return (*this)["time"]; }
  /// Largest magnitude of a column.
  double scale(const std::string& name) const;
};

/// Reads a netlist given as text (accuracy 0: as the text says). One that is refused throws std::runtime_error with the
/// message that a user would see.
Scene scene_of(const std::string& toml, double accuracy = 0);

/// Reads and runs a netlist given as text. A run that fails throws std::runtime_error with its message too.
RunTable simulate(const std::string& toml, double accuracy = 0);

/// Runs a scene. Throws SimulationError, also where the run would go on for ever.
RunTable simulate(const Scene& scene, Summary* summary = nullptr);

/// The outcome of a run: its rows, and the text of the SimulationError if it ended with one.
struct Attempt {
  RunTable rows;
  Summary summary;
  std::string refusal;
};
Attempt attempt(const Scene& scene);

/// The rows that a run has written to a file.
RunTable read_rows(std::FILE* csv);

/// By how much the record that is farthest from the same one of another run is off at its worst row, as a share of its scale
/// there. Fails the test if the rows are not at the same times.
double largest_error(const RunTable& rows, const RunTable& exact);

/// Largest difference of a column from a function of time, relative to the largest value of the function.
double error_of(const RunTable& rows, const std::string& column, const std::function<double(double)>& exact);

/// A `[simulate]` from 0 to `stop` [s] with 41 rows.
std::string simulate_until(double stop, double accuracy = 1e-9);

/// The message that `simulate` would throw; "" if it does not.
std::string refusal(const std::string& toml);

}  // namespace rheonet::test
