#pragma once

#include <string>
#include <vector>

#include "core/dae/start.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Where a run begins in which nothing changes but by the motion itself.
struct SteadyStart {
  Modes modes;                      ///< of the sliders
  std::vector<double> slider_force;
  std::vector<std::string> notes;   ///< what was left open, and how it was chosen
};

/// Takes a network from its start values to the steady state under its drives as they are at t: velocities that stay,
/// under forces that stay. With `scene.start_from` = rest the prescribed motions stand still. Gives `begin` its state, and
/// the memories of the laws theirs. `classified` is the structure with every slider slipping. Throws SimulationError,
/// with the elements and nodes concerned, where there is no such state.
SteadyStart settle(const Network& network, const Structure& classified, double t, Start& begin);

}  // namespace rheonet
