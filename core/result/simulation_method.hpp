#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result/run.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet {

/// A way to simulate a scene.
struct SimulationMethod {
  std::string name = {};          ///< "order up to 4"
  std::optional<Scene::Method> method = {};  ///< in place of the scene's
  int order = RunSettings{}.order;  ///< largest order of the integration method
  bool locate_events = true;      ///< see Integrator::Options
  bool certified = false;         ///< repeated runs until one is shown to be accurate (certify.hpp)
  std::vector<Scene> scene = {};  ///< at most one: a scene to simulate instead
};

/// Simulates a scene by a method, like `run` and `run_to_memory`; `order` is that of the method.
Summary run_by(const SimulationMethod& method, const Scene& scene, const RunSettings& settings);
Trajectory run_to_memory_by(const SimulationMethod& method, const Scene& scene, RunSettings settings);

}  // namespace rheonet
