#pragma once

#include <string>
#include <vector>

#include "core/dae/event_network.hpp"

namespace rheonet {

/// Steps of prescribed positions, in no time: how far they take other nodes along, and the momentum that they give.
class PositionSteps {
 public:
  /// The network must outlive this.
  explicit PositionSteps(const EventNetwork& net) : net_(net), told_(net.network.scene->elements.size(), 0) {}

  struct Steps {
    std::vector<double> dx;        ///< Steps of known and viscous nodes, and of nodes that rigid links join to known ones [m].
    std::vector<double> momentum;  ///< That dashpots give to masses [N s].
  };
  /// The steps at t, none unless the inputs have `stepped`. Adds messages on impulses to `notes`. Throws SimulationError if a step takes a
  /// force beyond any bound.
  Steps at_event(double t, bool stepped, const State& state, std::vector<std::string>& notes);

 private:
  const EventNetwork& net_;
  std::vector<char> told_;  ///< For each element: a message has reported its impulse.
};

}  // namespace rheonet
