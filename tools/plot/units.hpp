#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/netlist/units.hpp"

namespace rheonet::plot {

/// The quantity and unit of a column. Its values are in SI.
struct Measure {
  std::string quantity;      ///< "torque"; of a file that says no more, the column's name
  std::string unit;          ///< as typed: "N*m", "in*ozf"; "": nothing is known of it, "SI": only that
  std::optional<Unit> size;  ///< of that unit, if it is known
};

/// A measure in a unit that netlists know. Expects a unit that can be read.
Measure measure(const std::string& quantity, const std::string& unit);

/// Whether both can share an axis: the same dimension, and angles apart from numbers; of unknown units the same
/// quantity.
bool compatible(const Measure& a, const Measure& b);

/// The unit of an axis: its name in print and its size in SI.
struct Shown {
  std::string name;  ///< "mN·m"; "" for a number, and if nothing is known; `^` raises the following number
  double factor = 1;
};

/// The unit in which a measure is shown whose values have magnitudes up to `largest` (SI). It is the first of the wished units
/// that has its dimension, or else its own. An SI unit gets a decimal prefix (mm, kN) that makes the numbers easy to read.
/// A unit that takes no prefix gets a power of ten ("10^3 dyn·cm").
Shown shown(const Measure& measure, const std::vector<std::string>& wished, double largest);

/// A unit in print: "N·m", "m/s²".
std::string in_print(const std::string& unit);

}  // namespace rheonet::plot
