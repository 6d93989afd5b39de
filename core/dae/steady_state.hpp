#pragma once

#include <string>
#include <vector>

#include "core/dae/start.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Modes and slider forces at a start from rest or in steady motion.
struct SteadyStart {
  Modes modes;                      ///< of the sliders
  std::vector<double> slider_force;
  std::vector<std::string> notes;   ///< undetermined values, and how they were chosen
};

/// Takes a network from its start values to the steady state under its inputs at time t: constant velocities under constant
/// forces. With `scene.start_from` = rest the prescribed motions stand still. Gives `begin` its state, and the laws their
/// memories. `classified` is the structure with every slider slipping. Throws SimulationError, with the elements and nodes
/// concerned, if there is no such state.
SteadyStart settle(const Network& network, const Structure& classified, double t, Start& begin);

}  // namespace rheonet
