#pragma once

#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Pseudoplastic dashpots in series, with nothing else between them, that join two nodes, each massive or known. All have the
/// same force, and together they bring the masses to relative rest in a finite time.
struct StopChain {
  NodeId a, b;
  std::vector<int> rates;  ///< rate branches, one or more
};

/// Finds all stop chains in these modes.
std::vector<StopChain> find_stop_chains(const Network& network, const Structure& structure);

}  // namespace rheonet
