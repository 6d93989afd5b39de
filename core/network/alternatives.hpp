#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rheonet {

/// A law that stands in for another one because it is cheaper or easier to program. `rheonet precision --variants` measures
/// its cost and its error.
struct Alternative {
  std::string type = {};     ///< the component that declares it
  std::string name = {};     ///< label of the alternative, such as "smoothed"
  std::string becomes = {};  ///< type of the component that replaces the element
  /// Parameters of the replacement, from those of the element and a velocity [m/s] and a displacement [m] that are small for
  /// it.
  std::function<std::vector<double>(std::span<const double>, double speed, double length)> values = {};
};

/// All declared alternatives.
const std::vector<Alternative>& alternatives();

/// Registers an alternative. Define one at namespace scope in the file of the component.
struct RegisterAlternative {
  explicit RegisterAlternative(Alternative alternative);
};

}  // namespace rheonet
