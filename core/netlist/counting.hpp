#pragma once

#include <optional>

#include "core/netlist/expression.hpp"

namespace rheonet {

/// Products, powers and sums of numbers with dimensions. They count radians and cycles, to distinguish 2 pi f from f.
///
/// A radian is 1 in SI, and mechanics often omits it (N m/rad is N m): the exponent of rad may differ between the terms of
/// a sum. A cycle (Hz = cycle/s) is 2 pi radians and is never omitted from a rate: a frequency and an angular velocity
/// cannot be added. `pi` may be a number or the conversion between cycles and radians (2 pi f, omega/(2 pi)). Its exponent
/// is kept until a product decides: cycles times pi are radians; a rate without cycles divided by pi counts cycles.

/// Exponents of a*b; the value is a.value * b.value.
Number product(const Number& a, const Number& b);
/// Exponents of a^n; the value is a.value, not raised.
Number raised(const Number& a, double n);

/// Whether two terms of a sum, a comparison or a list of arguments have the same dimension and count the same angle unit.
enum class Likeness {
  alike,
  unlike,  ///< of different dimensions
  mixed,   ///< one counts cycles, the other radians
};
Likeness likeness(const Number& a, const Number& b);
/// Exponents of the sum of two numbers that are alike; the value is that of `a`.
Number common(const Number& a, const Number& b);

/// Whether `number` may be used where a number like `expected` is required.
bool fits(const Number& number, const Number& expected);

/// The error of a number used as an angle or a derivative of an angle (`of_angle`), or as a velocity along a line; absent
/// if the number is valid there.
std::optional<TextError> miscounted(const Number& number, bool of_angle);

/// Whether the number certainly counts cycles (Hz).
bool counts_cycles(const Number& number);
/// The dimension in words, for messages: "a frequency (Hz)", "an angular velocity (rad/s)", "a torque or an energy (N*m)".
std::string describe(const Number& number);

}  // namespace rheonet
