#include "core/netlist/counting.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

namespace {

constexpr double exponent_rounding = 1e-9;  // as for the exponents of Dimension

bool same_exponent(double a, double b) { return std::abs(a - b) <= exponent_rounding; }
bool vanishes(double exponent) { return same_exponent(exponent, 0); }

/// Whether the dimension is a power of time alone, or a pure number.
bool is_temporal(Dimension dimension) { return vanishes(dimension.metre) && vanishes(dimension.kilogram); }
bool is_rate(Dimension dimension) { return is_temporal(dimension) && dimension.second < -exponent_rounding; }

/// Moves the part of the exponent `from` that `pi` can convert to the exponent `to`.
void convert_by_pi(double& from, double& pi, double& to) {
  const double part = std::min(std::abs(from), std::abs(pi));
  const double moved = from > 0 ? part : -part;
  from -= moved;
  to += moved;
  pi -= pi > 0 ? part : -part;
}

/// Decides whether pi is a number or a conversion, as far as the exponents show. It is a number if `rate_in_radians`: the
/// factor with the rate already counted radians.
void settle(Number& number, bool rate_in_radians) {
  double &radian = number.radian, &hertz = number.hertz, &pi = number.pi;
  if (vanishes(pi)) return;
  if (pi * hertz > 0) convert_by_pi(hertz, pi, radian);  // 2 pi f; 1/(2 pi f)
  if (vanishes(pi) || !is_temporal(number.dimension)) return;
  const bool lasts = number.dimension.second > exponent_rounding;
  if (pi < 0 && radian > exponent_rounding && !lasts) convert_by_pi(radian, pi, hertz);  // omega/(2 pi), theta/(2 pi)
  if (pi > 0 && radian < -exponent_rounding && lasts) convert_by_pi(radian, pi, hertz);  // 2 pi/omega
  if (!is_rate(number.dimension)) return;
  if (pi < 0) {  // sqrt(k/m)/(2 pi)
    hertz -= pi;
    pi = 0;
  } else if (!rate_in_radians) {  // 2 pi/T
    radian += pi;
    pi = 0;
  }
}

/// Bounds of the number's exponent of cycles: pi may be a number or a conversion.
struct CycleRange {
  double least, most;
};
CycleRange cycles_of(const Number& number) {
  return {std::min(number.hertz, number.hertz - number.pi) - exponent_rounding,
          std::max(number.hertz, number.hertz - number.pi) + exponent_rounding};
}

/// Whether `number`, next to one that counts cycles, may count cycles as well: a count, a duration, the inverse of a typed time,
/// or a mechanical quantity without an angle.
bool may_count_cycles(const Number& number) {
  const Dimension& dimension = number.dimension;
  if (!vanishes(number.hertz) || !vanishes(number.radian)) return false;
  if (!is_temporal(dimension)) return true;
  return vanishes(number.pi) && (!is_rate(dimension) || same_exponent(number.typed_time, dimension.second));
}

/// Whether the number is a product like 2 pi times 600 rpm.
bool counts_radians_times_pi(const Number& number) { return number.radian > exponent_rounding && number.pi > exponent_rounding; }

}  // namespace

Number product(const Number& a, const Number& b) {
  Number result{.value = a.value * b.value,
                .dimension = a.dimension * b.dimension,
                .plain = a.plain || b.plain,
                .radian = a.radian + b.radian,
                .hertz = a.hertz + b.hertz,
                .pi = a.pi + b.pi,
                .typed_time = a.typed_time + b.typed_time};
  const auto in_radians = [](const Number& factor) { return is_rate(factor.dimension) && factor.radian > exponent_rounding; };
  settle(result, in_radians(a) || in_radians(b));
  return result;
}

Number raised(const Number& a, double n) {
  Number result{.value = a.value,
                .dimension = a.dimension.power(n),
                .plain = a.plain,
                .radian = n * a.radian,
                .hertz = n * a.hertz,
                .pi = n * a.pi,
                .typed_time = n * a.typed_time};
  settle(result, result.radian > exponent_rounding);
  return result;
}

Likeness likeness(const Number& a, const Number& b) {
  if (a.plain || b.plain) return Likeness::alike;
  if (!a.dimension.same(b.dimension)) return Likeness::unlike;
  const CycleRange x = cycles_of(a), y = cycles_of(b);
  if (x.least <= y.most && y.least <= x.most) return Likeness::alike;
  return may_count_cycles(a) || may_count_cycles(b) ? Likeness::alike : Likeness::mixed;
}

Number common(const Number& a, const Number& b) {
  if (a.plain || b.plain) {
    Number one = a.plain ? b : a;
    one.value = a.value;
    return one;
  }
  const auto shared = [](double x, double y) { return same_exponent(x, y) ? x : 0; };
  const auto either = [](double x, double y) { return vanishes(x) ? y : x; };
  Number result = a;
  result.radian = shared(a.radian, b.radian);
  result.hertz = same_exponent(a.hertz, b.hertz) ? a.hertz : either(a.hertz, b.hertz);
  result.pi = is_rate(a.dimension) ? either(a.pi, b.pi) : shared(a.pi, b.pi);
  result.typed_time = shared(a.typed_time, b.typed_time);
  return result;
}

bool counts_cycles(const Number& number) {
  const CycleRange cycles = cycles_of(number);
  return cycles.least > 0 || cycles.most < 0;
}

bool fits(const Number& number, const Number& expected) {
  if (number.plain || expected.plain) return true;
  const bool of_angle = expected.radian > exponent_rounding && is_temporal(expected.dimension);
  return likeness(number, expected) == Likeness::alike && !(of_angle && counts_radians_times_pi(number));
}

std::optional<TextError> miscounted(const Number& number, bool of_angle) {
  if (number.plain) return {};
  if (counts_radians_times_pi(number))
    return TextError{0, "found pi times what is in radians already (rad/s, deg/s or rpm, which is 2*pi/60 rad/s)",
                     "leave out `2*pi`, or give a frequency in Hz; an angle may be in deg"};
  if (of_angle && counts_cycles(number))
    return TextError{0, is_rate(number.dimension) ? "found a frequency in Hz" : "found a number of cycles",
                     "write `rad/s`, `deg/s` or `rpm`; with a frequency f, `2*pi*f`"};
  return {};
}

std::string describe(const Number& number) {
  if (counts_radians_times_pi(number) && is_temporal(number.dimension)) return "pi times what is in radians";
  if (same_exponent(number.hertz, 1) && vanishes(number.radian) && is_temporal(number.dimension)) {
    if (same_exponent(number.dimension.second, -1)) return "a frequency (Hz)";
    if (number.dimension.is_number()) return "a number of cycles";
  }
  return describe(number.dimension, number.radian);
}

}  // namespace rheonet
