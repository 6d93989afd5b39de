#pragma once

#include "core/dae/drive.hpp"
#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// A network just before its run, and what drives it.
struct Start {
  State state;
  Drive drive;
};

/// From the start values of nodes and elements. Throws SimulationError for those that contradict each other.
Start start(const Network& network);

}  // namespace rheonet
