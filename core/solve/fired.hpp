#pragma once

#include <vector>

#include "core/dae/instant.hpp"
#include "core/solve/systems.hpp"

namespace rheonet {

/// What has come to an event at the end of the integrator's last step.
struct Fired {
  Instant::Fired sudden;      ///< what the instant has to decide about
  std::vector<int> limits;    ///< of blocks
  std::vector<int> elements;  ///< of the scene, all of them
};

/// Switches the memories of the laws that have come to one, in the state at t. One event may be that of several laws: of
/// those that stand between the same ends, and of those that move at one velocity.
Fired take_events(System& system, double t, const std::vector<double>& y, const std::vector<double>& yp);

}  // namespace rheonet
