#pragma once

#include "core/network/structure.hpp"

namespace rheonet {

/// Writes the equations of the trains (Structure::train_equations), whose nodes become massive, and the inertia that is felt at each of them.
/// Equations that follow from others are left out: in some modes sliders lock all nodes of a train. Without modes no slider
/// holds anything: throws SimulationError for a train that has no equation of its own, or whose nodes have too little inertia to
/// determine their motion.
void assign_trains(const Network& network, Structure& structure, const Modes* modes);

}  // namespace rheonet
