#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rheonet {

/// A law that stands in for another one because it is cheaper or easier to program. `rheonet precision --variants` measures
/// its cost and its error.
struct SurrogateLaw {
  std::string type = {};     ///< the component that declares it
  std::string name = {};     ///< label of the alternative, such as "smoothed"
  std::string becomes = {};  ///< type of the component that replaces the element
  /// Its parameters, from those of the element, a small velocity `speed` [m/s] and a small displacement `length` [m].
  std::function<std::vector<double>(std::span<const double>, double speed, double length)> values = {};
};

/// All declared alternatives.
const std::vector<SurrogateLaw>& surrogate_laws();

/// Registers an alternative. Define one at namespace scope in the file of the component.
struct RegisterSurrogate {
  explicit RegisterSurrogate(SurrogateLaw alternative);
};

}  // namespace rheonet
