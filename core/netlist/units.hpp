#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/netlist/dimension.hpp"

namespace rheonet {

/// A unit as typed: one such unit is `factor` SI units of the same dimension.
struct Unit {
  double factor = 1;
  Dimension dimension;
  double radian = 0;  ///< exponent of rad, which `dimension` ignores: distinguishes rad/s from 1/s
  double hertz = 0;   ///< exponent of Hz: distinguishes Hz, which is no angular velocity, from 1/s, which may be one
};

/// The reason why a text is no unit or no expression. `offset` counts characters (code points) from the start of the text.
struct TextError {
  std::size_t offset = 0;
  std::string message;
  std::string hint;
};

/// Reads products, quotients and powers of the units of UDUNITS-2, and of dyn, deg, rev and P (poise), which UDUNITS-2
/// names differently: "N*m*s/rad", "in*ozf", "N*(s/m)^0.5", "N s/m", "cSt". Units with an offset (degC) are refused.
std::variant<Unit, TextError> parse_unit(std::string_view text);

/// value * factor, correctly rounded for fractions: 1 ms is 1/1000 s, not 0.001 s, so that 1.1 ms is the double nearest to
/// 0.0011.
double multiplied(double value, double factor);

}  // namespace rheonet
