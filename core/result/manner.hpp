#pragma once

#include <string>
#include <vector>

#include "core/result/course.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// How a scene is simulated.
struct Manner {
  std::string name = {};          ///< "order up to 4"
  int order = RunSettings{}.order;  ///< of the method, at most
  bool locate_events = true;      ///< see Integrator::Options
  bool certified = false;         ///< run after run, until one is known to be as accurate as asked (certify.hpp)
  std::vector<Scene> scene = {};  ///< one that is simulated in its place; none: itself
};

/// Simulates a scene in a manner: as `run` and `run_to_memory`, but for `order`, which is the manner's.
Summary run_in(const Manner& manner, const Scene& scene, const RunSettings& settings);
Course run_to_memory_in(const Manner& manner, const Scene& scene, RunSettings settings);

}  // namespace rheonet
