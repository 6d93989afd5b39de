#pragma once

#include <string>
#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// A network just before its run, and its inputs.
struct Start {
  /// From the start values of nodes and elements; `classified` is the structure with every slider slipping. Throws
  /// SimulationError if they contradict each other.
  Start(const Network& network, const Structure& classified);

  Inputs inputs;
  State state;
  std::vector<std::string> chosen;  ///< values that were neither given nor implied, in words

  struct Places;
 private:
  Start(const Network& network, const Structure& classified, const Places& places);
};

struct StartWords {
  std::vector<std::string> notes;   ///< given values that could not be used
  std::vector<std::string> chosen;  ///< as in Start, and the positions of massless nodes
};

/// Messages on a start after its first event; `velocity` holds the velocities of the nodes then.
StartWords describe_start(const Start& start, const Network& network, const Structure& classified,
                          const std::vector<double>& velocity);

}  // namespace rheonet
