#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tests/wiring/catalogue.hpp"

namespace rheonet::test {

/// The scene of a wiring as another one that must give the same trajectory.
struct View {
  /// column = factor * (that of the scene) + offset + rate * time
  struct Column { std::string path, original; double factor = 1, offset = 0, rate = 0; };
  std::string name;
  Scene scene;
  std::vector<Column> columns;
  double time = 1;  ///< unit of time of this one in that of the scene
};

/// All that apply: other names and another order; all ends swapped; units of 1e-9 and 1e9; a moving frame, unless a
/// position is prescribed; the members of all groups in reverse order, if no mass lies between them.
std::vector<View> seen_differently(const Wiring& wiring, const Scene& scene);

/// The scene with one reduction each, and with all; recording all, and some. `unreduced` has none.
std::vector<View> reduced(const Scene& scene, const Scene& unreduced);

}  // namespace rheonet::test
