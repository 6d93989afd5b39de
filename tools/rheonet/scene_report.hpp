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
  bool precision = false;  ///< also what accuracy costs
  const std::atomic<bool>* interrupt = nullptr;
};

/// A scene's part of a report.
struct SceneReport {
  std::vector<std::string> messages;       ///< for report::document
  std::vector<std::string> failures;       ///< what the scene did not do as it should, each a line
  std::optional<Certificate> certificate;  ///< if it was asked for
};

/// Simulates a scene for a report; `file` is what the scene is called. Adds to what it records. Throws SimulationError on an interrupt, or
/// if the scene is to be certified and cannot be simulated.
SceneReport report_scene(ReadResult& read, const std::string& file, const SceneReportWanted& wanted);

}  // namespace rheonet::tool
