#pragma once

#include <cmath>

namespace rheonet {

/// A value and its derivative with respect to one variable: x + x' eps with eps^2 = 0. A law written once for a number
/// type T gives its force with T = double, and its exact derivative with T = Dual.
struct Dual {
  double value = 0;
  double derivative = 0;

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: a constant is a Dual with derivative 0
  Dual(double v, double d) : value(v), derivative(d) {}

  friend Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.derivative + b.derivative}; }
  friend Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.derivative - b.derivative}; }
  friend Dual operator-(Dual a) { return {-a.value, -a.derivative}; }
  friend Dual operator*(Dual a, Dual b) { return {a.value * b.value, a.derivative * b.value + a.value * b.derivative}; }
  friend Dual operator/(Dual a, Dual b) {
    return {a.value / b.value, (a.derivative - a.value / b.value * b.derivative) / b.value};
  }
  friend bool operator<(Dual a, Dual b) { return a.value < b.value; }
  friend bool operator>(Dual a, Dual b) { return a.value > b.value; }
  friend bool operator<=(Dual a, Dual b) { return a.value <= b.value; }
  friend bool operator>=(Dual a, Dual b) { return a.value >= b.value; }
};

inline double value_of(double x) { return x; }
inline double value_of(Dual x) { return x.value; }

inline Dual abs(Dual x) { return x.value < 0 ? -x : x; }
inline Dual exp(Dual x) {
  const double e = std::exp(x.value);
  return {e, e * x.derivative};
}
inline Dual expm1(Dual x) { return {std::expm1(x.value), std::exp(x.value) * x.derivative}; }
inline Dual log1p(Dual x) { return {std::log1p(x.value), x.derivative / (1 + x.value)}; }
inline Dual sqrt(Dual x) {
  const double r = std::sqrt(x.value);
  return {r, x.derivative / (2 * r)};
}
inline Dual sin(Dual x) { return {std::sin(x.value), std::cos(x.value) * x.derivative}; }
inline Dual cos(Dual x) { return {std::cos(x.value), -std::sin(x.value) * x.derivative}; }
inline Dual tanh(Dual x) {
  const double t = std::tanh(x.value);
  return {t, (1 - t * t) * x.derivative};
}
/// x^n for x >= 0 and a constant n. At x = 0 the derivative is taken as 0 for n > 1, and n for n = 1; n < 1 has none there.
inline Dual pow(Dual x, double n) {
  if (x.value == 0) return {n == 0 ? 1.0 : 0.0, n == 1 ? x.derivative : 0.0};
  const double p = std::pow(x.value, n);
  return {p, n * p / x.value * x.derivative};
}

}  // namespace rheonet
