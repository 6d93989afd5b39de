#pragma once

#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Pseudoplastic dashpots in series, with nothing else between them, from one node that has a mass or moves as it is given to, to
/// another: all have one force, and together they bring the masses to rest against each other at a finite time.
struct StopChain {
  NodeId a, b;
  std::vector<int> rates;  ///< rate branches, one or more
};

/// All there are, in these modes.
std::vector<StopChain> find_stop_chains(const Network& network, const Structure& structure);

}  // namespace rheonet
