#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace rheonet {

/// Another law that is used in place of one, because it costs less or is easier to program: `rheonet precision --variants`
/// says what it costs, and what it gets wrong.
struct Alternative {
  std::string type = {};     ///< the component that declares it
  std::string name = {};     ///< "smoothed": what an element then is
  std::string becomes = {};  ///< a component's type
  /// Its parameters, from those of the element and a velocity [m/s] and a displacement [m] that are small for it.
  std::function<std::vector<double>(std::span<const double>, double speed, double length)> values = {};
};

/// All that are declared.
const std::vector<Alternative>& alternatives();

/// Put one at namespace scope in the file of the component.
struct RegisterAlternative {
  explicit RegisterAlternative(Alternative alternative);
};

}  // namespace rheonet
