#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/read.hpp"
#include "core/result/certify.hpp"

namespace rheonet::tool {

struct SceneReportWanted {
  bool certify = false;
  bool precision = false;  ///< Add a measurement of CPU time against error.
  const std::atomic<bool>* interrupt = nullptr;
};

/// A scene's part of a report.
struct SceneReport {
  std::vector<std::string> messages;       ///< For report::document.
  std::vector<std::string> failures;       ///< One line for each failure of the scene.
  std::optional<Certificate> certificate;  ///< Present if it was requested.
};

/// Simulates a scene for a report; `file` is the name of the scene. Adds records to the scene. Throws SimulationError on an interrupt, or if
/// the scene is to be certified and cannot be simulated.
SceneReport report_scene(ReadResult& read, const std::string& file, const SceneReportWanted& wanted);

}  // namespace rheonet::tool
