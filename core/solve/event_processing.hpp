#pragma once

#include <vector>

#include "core/dae/event_transition.hpp"
#include "core/solve/mode_cache.hpp"

namespace rheonet {

/// The events at the end of the integrator's last step.
struct Fired {
  EventTransition::Fired sudden;      ///< sliders and laws whose next modes EventTransition has to select
  std::vector<int> limits;    ///< limits of blocks that fired
  std::vector<int> elements;  ///< indices into Scene::elements of all elements that fired
};

/// Switches the memories of the laws whose event fired, in the state at t. An event also switches laws in parallel that are
/// held at rest together, and laws that reverse at the same velocity.
Fired take_events(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp);

/// Starts the laws that rest by their memory although the equations give them a velocity (NetworkEvents::contradicted), in the direction
/// of that velocity. Mode selection solves a convex problem over a short time, whose round-off may hide the velocity.
Fired take_contradictions(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp);

}  // namespace rheonet
