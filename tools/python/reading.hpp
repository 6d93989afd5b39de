#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/read.hpp"
#include "tools/python/run.hpp"

namespace rheonet::python {

/// Options of a simulation.
struct RunWanted {
  std::optional<double> accuracy = {};  ///< Overrides the accuracy of the scene.
  bool certified = false;
  int threads = 1;
  bool both_sides = false;  ///< Add rows at both sides of each event, for a figure.
};

/// A netlist that has been read: the scene, or its mistakes.
class Reading {
 public:
  Reading(std::string file, ReadResult result);

  bool complete() const { return scene_ != nullptr; }
  const std::string& file() const { return file_; }
  const Scene& scene() const { return *scene_; }
  const Sources& sources() const { return *sources_; }

  /// The result as the commands use it, with the scene's accuracy replaced by `accuracy`.
  ReadResult read_result(std::optional<double> accuracy) const;

  py::list diagnostics() const;
  /// Of each mistake in the overrides and measures: the index of its text among them, and whether it is in the path of an override.
  std::vector<std::pair<int, bool>> mistakes_in_changes() const;
  py::dict units() const;
  std::unique_ptr<Run> run(const RunWanted& wanted, const py::object& progress) const;

  /// The JSON of `rheonet explain --json`. Raises rheonet.SimulationError if the scene cannot start.
  std::string explanation() const;

  /// The run of this scene that had these rows, for a figure.
  std::unique_ptr<Run> run_with(std::vector<double> times, std::vector<std::vector<double>> columns) const;

  /// The SVG of the network; absent if it is too large to be drawn.
  std::optional<std::string> schematic() const;

 private:
  std::shared_ptr<const Scene> with_accuracy(std::optional<double> accuracy) const;

  std::string file_;  ///< Name of the netlist.
  std::shared_ptr<const Sources> sources_;
  std::shared_ptr<const Scene> scene_;  ///< nullptr if there is a mistake.
  Presentation presentation_;
  std::vector<Diagnostic> diagnostics_;
};

/// A netlist before it is read: a file, or a text, which messages call `file`. Files are read from disk only once, so that every reading has
/// the same contents.
class Source {
 public:
  using Files = std::vector<std::pair<py::bytes, py::bytes>>;
  /// `texts` and `canonical`: what another Source has read: see `state`.
  Source(std::string file, std::optional<std::string> text, std::string folder, const Files& texts = {}, const Files& canonical = {});

  const std::string& file() const { return file_; }
  /// The arguments of a Source that has read what this one has, in any process, with absolute paths.
  py::tuple state();

  struct Wanted {
    std::vector<std::string> overrides;                   ///< "PATH=VALUE".
    std::optional<std::vector<std::string>> measures;     ///< Replace the claims of the file, which hold for the unmodified scene.
    std::vector<std::string> model_folders;               ///< Folders that `include` falls back on.
    std::vector<std::string> records;                     ///< In addition to the records of the file.
    bool plotted = false;                                 ///< Add the records that `[plot]` draws.
  };
  Reading read(Wanted wanted);

 private:
  std::string file_;
  std::optional<std::string> text_;
  std::string folder_;  ///< Folder of the files that a text includes.
  std::filesystem::path working_folder_ = std::filesystem::current_path();  ///< Relative paths refer to it.
  FileCache cache_;
};

}  // namespace rheonet::python
