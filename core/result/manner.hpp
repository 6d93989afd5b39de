#pragma once

#include <string>
#include <vector>

#include "core/result/course.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// A way to simulate a scene.
struct Manner {
  std::string name = {};          ///< "order up to 4"
  int order = RunSettings{}.order;  ///< largest order of the integration method
  bool locate_events = true;      ///< see Integrator::Options
  bool certified = false;         ///< repeated runs until one is shown to be accurate (certify.hpp)
  std::vector<Scene> scene = {};  ///< at most one: a scene to simulate instead
};

/// Simulates a scene in a manner, like `run` and `run_to_memory`; `order` is that of the manner.
Summary run_in(const Manner& manner, const Scene& scene, const RunSettings& settings);
Course run_to_memory_in(const Manner& manner, const Scene& scene, RunSettings settings);

}  // namespace rheonet
