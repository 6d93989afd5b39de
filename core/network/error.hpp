#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "core/netlist/diagnostic.hpp"

namespace rheonet {

/// A scene that can be read but not simulated. `what()` names elements or nodes, and the time where there is one.
struct SimulationError : std::runtime_error {
  using std::runtime_error::runtime_error;
  SimulationError(const Spot& where, const std::string& reason) : runtime_error(reason), spot(where) {}

  std::optional<Spot> spot;  ///< the place in the netlist, if the cause is there; absent if the error arises during the run
};

/// The equations do not determine the motion, or have no consistent state.
class UndeterminedError : public SimulationError {
 public:
  using SimulationError::SimulationError;
};

}  // namespace rheonet
