#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tests/wiring/catalogue.hpp"

namespace rheonet::test {

/// Another form of a wiring's scene, which must give the same trajectory.
struct View {
  /// column = factor * (column of the scene) + offset + rate * time.
  struct Column { std::string path, original; double factor = 1, offset = 0, rate = 0; };
  std::string name;
  Scene scene;
  std::vector<Column> columns;
  double time = 1;  ///< Unit of time of the view, in units of the scene.
};

/// All applicable views: other names and another order; all ends swapped; units of 1e-9 and 1e9; a moving frame, unless a position is
/// prescribed; the members of all groups in reverse order, if no mass is between them.
std::vector<View> seen_differently(const Wiring& wiring, const Scene& scene);

/// The scene with each single reduction and with all, each with all records and with some. `unreduced` has no reductions.
std::vector<View> reduced(const Scene& scene, const Scene& unreduced);

}  // namespace rheonet::test
