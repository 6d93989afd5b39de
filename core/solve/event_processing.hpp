#pragma once

#include <vector>

#include "core/dae/event_transition.hpp"
#include "core/solve/mode_cache.hpp"

namespace rheonet {

/// The events at the end of the integrator's last step.
struct Fired {
  FiredGuards guards;      ///< sliders and laws whose next modes EventTransition has to select
  std::vector<int> limits;    ///< limits of blocks that fired
  std::vector<int> elements;  ///< indices into Scene::elements of all elements that fired
};

/// Switches the memories of the laws whose event fired, in the state at t. An event also switches laws in parallel that are
/// held at rest together, and laws that reverse at the same velocity.
Fired take_events(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp);

/// Starts laws that rest although the equations contradict that (NetworkEvents::contradicted), in the direction that these say. Mode selection
/// solves a convex problem over a short time: round-off may hide a velocity there, and an error of a deflection may hold a law above its bound.
Fired take_contradictions(System& system, const std::vector<NetworkEvents::Contradicted>& laws, double t, const std::vector<double>& y,
                          const std::vector<double>& yp);

}  // namespace rheonet
