#pragma once

#include <optional>

#include "core/netlist/expression.hpp"

namespace rheonet {

/// Products, powers and sums of numbers with dimensions, and the books on radians and cycles that tell 2 pi f from f.
///
/// A radian is 1 in SI, and mechanics leaves it out where it likes (N m/rad is N m): its exponent may differ between the
/// terms of a sum. A cycle (Hz = cycle/s) is 2 pi radians and is never left out of a rate: a frequency and an angular
/// velocity do not add. `pi` may be a number or the conversion between the two (2 pi f, omega/(2 pi)); its exponent is kept
/// until a product shows which: cycles times pi are radians, a rate without cycles over pi counts cycles.

/// Exponents of a*b; the value is a.value * b.value.
Number product(const Number& a, const Number& b);
/// Exponents of a^n; the value is left alone.
Number raised(const Number& a, double n);

/// How two terms of a sum, a comparison or a list of arguments agree.
enum class Likeness {
  alike,
  unlike,  ///< of different dimensions
  mixed,   ///< one counts cycles, the other radians
};
Likeness likeness(const Number& a, const Number& b);
/// Exponents of a sum of two that are alike; the value is that of `a`.
Number common(const Number& a, const Number& b);

/// Whether a number may stand where another is expected.
bool fits(const Number& number, const Number& expected);

/// What is wrong with a number that is used as an angle or its derivatives (`of_angle`), or as a velocity along a line.
std::optional<TextError> miscounted(const Number& number, bool of_angle);

/// Whether it counts cycles (Hz) for certain.
bool counts_cycles(const Number& number);
/// In words, for messages: "a frequency (Hz)", "an angular velocity (rad/s)", "a torque or an energy (N*m)".
std::string describe(const Number& number);

}  // namespace rheonet
