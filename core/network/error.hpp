#pragma once

#include <stdexcept>

namespace rheonet {

/// A scene that can be read but not simulated. `what()` names elements or nodes, and the time where there is one.
struct SimulationError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace rheonet
