#pragma once

#include <vector>

#include "core/network/network.hpp"
#include "core/result/explain.hpp"

namespace rheonet {

/// Events possible in a network, from its laws and from discontinuities of its signals.
struct PossibleEvents {
  std::vector<Explanation::Events> events = {};
  long known_instants = 0;  ///< jumps and corners of signals until the stop
};

PossibleEvents possible_events(const Network& network);

}  // namespace rheonet
