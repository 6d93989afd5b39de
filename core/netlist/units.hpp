#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/netlist/dimension.hpp"

namespace rheonet {

/// A unit as typed: 1 of it is `factor` of the SI unit of the same dimension.
struct Unit {
  double factor = 1;
  Dimension dimension;
  double radian = 0;  ///< exponent of rad in it, which `dimension` ignores: tells rad/s from 1/s
  double hertz = 0;   ///< exponent of Hz in it: tells Hz, which is no angular velocity, from 1/s, which may be one
};

/// Why a piece of text is no unit or no expression. `offset` counts characters (code points) from the start of the
/// text.
struct TextError {
  std::size_t offset = 0;
  std::string message;
  std::string hint;
};

/// Reads products, quotients and powers of the units that UDUNITS-2 knows, and of dyn, deg, rev, P (poise), which it knows
/// by other names: "N*m*s/rad", "in*ozf", "N*(s/m)^0.5", "N s/m", "cSt". Units with an offset (degC) are refused.
std::variant<Unit, TextError> parse_unit(std::string_view text);

/// value * factor. A unit that is a fraction, such as ms, is 1/1000 and not 0.001: 1.1 of it are then the double nearest to
/// 0.0011.
double multiplied(double value, double factor);

}  // namespace rheonet
