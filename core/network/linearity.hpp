#pragma once

#include <optional>
#include <string>

#include "core/network/network.hpp"

namespace rheonet {

/// Why the equations of a network are not linear with constant coefficients between two events, under inputs of constants, ramps and sines.
struct NotLinear {
  Spot spot;
  std::string reason;  ///< "the law of `c1` (cfm) is not linear"
};

/// Absent if they are: then exact_arc.hpp solves them in closed form. It follows from what the laws declare, in all their modes.
std::optional<NotLinear> not_linear(const Network& network);
/// The same for a scene that is yet to become a network.
std::optional<NotLinear> not_linear(const Scene& scene);

/// A scene's network, prepared for the method that solves it.
class NetworkOfMethod {
 public:
  /// Throws SimulationError if the method is `exact`, and the equations are not linear.
  NetworkOfMethod(const Scene& scene, Scene::Method method);

  const Network& network() const { return network_; }
  bool exact() const { return exact_; }  ///< exact arcs solve it
  /// Why they do not; absent if the method is `ida`.
  const std::optional<NotLinear>& obstacle() const { return obstacle_; }

 private:
  Network network_;
  std::optional<NotLinear> obstacle_;
  bool exact_;
};

}  // namespace rheonet
