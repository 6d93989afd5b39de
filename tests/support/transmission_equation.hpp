#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// A transmission: the sum of these factors times the displacements of its first node, its second node and its support is 0, and it
/// exerts its force times these factors on them.
struct TransmissionEquation {
  std::array<double, 3> factor;
  double efficiency = 1, efficiency_back = 1;  ///< While the first node drives, and while the second one does.
  double bearing = 0;                          ///< Friction, seen at the first node [N].

  bool lossy() const { return efficiency != 1 || efficiency_back != 1 || bearing != 0; }
  /// The friction at the first node, for a force `passed` on to the second node: `high` while it turns forwards, `low` while backwards.
  /// It is f - passed, where f is (passed +- bearing)/efficiency while the first node drives, else efficiency_back (passed +- bearing).
  struct Range { double low, high; };
  Range friction(double passed) const;
};

/// The equation of an element of this type, if it is a transmission.
std::optional<TransmissionEquation> transmission_equation(const std::string& type, const SceneElement& element);

}  // namespace rheonet::test
