#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>

#include "core/netlist/dimension.hpp"
#include "core/netlist/units.hpp"

namespace rheonet {

/// A value with its dimension, in SI. A plain number has no unit: it is taken as SI for any quantity. The result of an
/// expression is plain if all its parameters are.
struct Number {
  double value = 0;
  Dimension dimension;
  bool plain = true;
  double radian = 0;      ///< Exponent of rad, as in Unit.
  double hertz = 0;       ///< Exponent of cycles: of Hz, as in Unit, and of expressions that count cycles, such as omega/(2*pi).
  double pi = 0;          ///< Exponent of pi while it may be a number or the conversion of cycles (counting.hpp).
  double typed_time = 0;  ///< Part of the exponent of s that stems from typed times: 1/T of a time T is a frequency.
};

/// `value` times `unit`. The inverse of a unit of time other than s counts cycles, as Hz does: 600 1/min are 10 Hz.
Number number_in(double value, const Unit& unit);

/// Names that an expression may use. Names not found here are searched for in `outer`.
struct Environment {
  std::map<std::string, Number, std::less<>> names;
  const Environment* outer = nullptr;
  std::string known = {};  ///< Lists them, in the hint of an unknown name.

  const Number* find(std::string_view name) const;
};

/// Evaluates "2*B", "sqrt(k*m)", `a > b ? a : b`, ...; `pi` and the functions of functions.hpp are known. The value is
/// finite, unless a parameter is infinite. The dimension of the result follows from those of the parameters: adding metres
/// to seconds or Hz to rad/s, or the sine of a length, is an error. Only the chosen branch of `a > b ? x : y` is evaluated.
/// Unknown names are errors with the nearest name as hint.
std::variant<Number, TextError> evaluate_expression(std::string_view text, const Environment& environment);

/// Evaluates a value given as a string: "10", "2 in*ozf" (a number, a space, a unit), "inf" (plain), or an expression.
std::variant<Number, TextError> evaluate_text(std::string_view text, const Environment& environment);

/// The text of a quantity or an expression, multiplied: "2 N/m" becomes "2.2 N/m", "k/2" becomes "(k/2)*1.1".
std::string multiplied(std::string_view text, double factor);

/// The SI value of `number` as `quantity`, or a dimension error: "expected a torsional stiffness (N*m/rad), found a length
/// (m)". An angular velocity (rad/s, rpm) used as a frequency is divided by 2 pi. Where cycles or radians may be meant, the
/// result is an error: 1/s from an expression is no frequency, cycles are no angle and Hz is no angular velocity.
std::variant<double, TextError> as_quantity(const Number& number, Quantity quantity, Domain domain,
                                            double flow_index = 1);

}  // namespace rheonet
