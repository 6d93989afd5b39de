#pragma once

#include <string>
#include <vector>

#include "core/dae/drive.hpp"
#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// A network just before its run, and what drives it.
struct Start {
  State state;
  Drive drive;
  std::vector<std::string> chosen;  ///< what was not given and does not follow from anything else
};

/// From the start values of nodes and elements; `classified` is the structure with every slider slipping. Throws
/// SimulationError for those that contradict each other.
Start start(const Network& network, const Structure& classified);

struct StartWords {
  std::vector<std::string> notes;   ///< given values that nothing could be made of
  std::vector<std::string> chosen;  ///< as in Start, and where massless nodes have gone
};

/// What there is to say of a start when its first instant is over; `velocity` are those of the nodes then.
StartWords describe_start(const Start& start, const Network& network, const Structure& classified,
                          const std::vector<double>& velocity);

}  // namespace rheonet
