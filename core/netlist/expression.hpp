#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "core/netlist/dimension.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

/// A value with its dimension, in SI. A plain number has no unit: it is taken as SI whatever quantity it is used for. The
/// result of an expression is plain if all its parameters are.
struct Number {
  double value = 0;
  Dimension dimension;
  bool plain = true;
  double radian = 0;  ///< exponent of rad, as in Unit; `pi` counts as an angle, so that omega/(2*pi) has none
  double hertz = 0;   ///< exponent of Hz, as in Unit
};

/// Names that an expression may use, innermost first; `outer` is searched for those not found.
struct Environment {
  std::map<std::string, Number, std::less<>> names;
  const Environment* outer = nullptr;

  const Number* find(std::string_view name) const;
};

/// Evaluates "2*B", "sqrt(k*m)", "if"-style `a > b ? a : b`, ... with muParser; `pi` is known, and the functions sin, cos,
/// tan, asin, acos, atan, atan2, sinh, cosh, tanh, asinh, acosh, atanh, exp, ln, log10, log2, sqrt, abs, floor, ceil,
/// round, sign, min, max. The value is finite, unless a parameter is infinite. The dimension of the result
/// follows from those of the parameters: adding metres to seconds, or the sine of a length, is an error. Unknown names are
/// errors with the nearest name as hint.
std::variant<Number, TextError> evaluate_expression(std::string_view text, const Environment& environment);

/// A value as a string: "10", "2 in*ozf" (a number, a space, a unit), "inf" (plain), or an expression.
std::variant<Number, TextError> evaluate_text(std::string_view text, const Environment& environment);

/// The SI value of `number` as `quantity`, or what is wrong with its dimension: "expected a torsional stiffness (N*m/rad),
/// found a length (m)". A frequency with one rad in its unit (rad/s, rpm) is divided by 2 pi; an angular velocity in Hz is
/// refused, for want of knowing whether cycles or radians were meant.
std::variant<double, TextError> as_quantity(const Number& number, Quantity quantity, Domain domain,
                                            double flow_index = 1);

}  // namespace rheonet
