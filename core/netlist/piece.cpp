#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/numerics.hpp"
#include "core/netlist/curve.hpp"
#include "core/netlist/fresnel.hpp"
#include "core/netlist/signal.hpp"
#include "core/netlist/time_point.hpp"

namespace rheonet {

namespace {

// An angle is known to its last digit. A sine or a cosine that is no more than this is 0: a cosine begins at rest.
double exact_at_zero(double value, double angle) { return std::abs(value) <= std::numeric_limits<double>::epsilon() * std::abs(angle) ? 0 : value; }
double sine(double angle) { return exact_at_zero(std::sin(angle), angle); }
double cosine(double angle) { return exact_at_zero(std::cos(angle), angle); }

double sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

/// (x - sin x)/x^2; by its series where the difference would lose digits.
double lag_of_sine(double x) {
  if (std::abs(x) > 1) return (x - std::sin(x)) / (x * x);
  double term = x / 6, sum = term;
  for (int k = 4; std::abs(term) > std::numeric_limits<double>::epsilon() * std::abs(sum); k += 2) sum += term *= -x * x / (k * (k + 1));
  return sum;
}

}  // namespace

Piece Piece::integral_from(double t, double value) const {
  Piece result = *this;
  result.integrated = true;
  result.begin = t;
  result.begin_value = value;
  return result;
}

Piece Piece::integrand() const {
  Piece result = *this;
  result.integrated = false;
  return result;
}

double Piece::value(double t) const { return integrated ? begin_value + area(begin, t) : function(t); }

double Piece::rate(double t) const { return integrated ? function(t) : slope_at(t); }

double Piece::integral(double from, double to) const {
  if (!integrated) return area(from, to);
  return (to - from) * value(from) + area_of_area(from, to);
}

double Piece::function(double t) const {
  if (curve) return curve->value(t);
  const double tau = t - origin;
  const double wave = amplitude == 0 ? 0 : amplitude * sine(phase + (omega + chirp * tau / 2) * tau);
  return level + slope * tau + wave;
}

double Piece::slope_at(double t) const {
  if (curve) return curve->rate(t);
  if (amplitude == 0) return slope;
  const double tau = t - origin;
  return slope + amplitude * (omega + chirp * tau) * cosine(phase + (omega + chirp * tau / 2) * tau);
}

double Piece::curvature(double t) const {
  if (integrated) return slope_at(t);
  if (curve) return curve->curvature(t);
  if (amplitude == 0) return 0;
  const double tau = t - origin;
  const double angle = phase + (omega + chirp * tau / 2) * tau;
  const double angle_rate = omega + chirp * tau;
  return amplitude * (chirp * cosine(angle) - angle_rate * angle_rate * sine(angle));
}

double Piece::area(double from, double to) const {
  if (curve) return curve->area(to) - curve->area(from);
  const double length = to - from;
  const double a = from - origin;
  const double b = to - origin;
  const double straight = length * (level + slope * (a + b) / 2);
  if (amplitude == 0) return straight;
  if (chirp == 0)  // the difference of two cosines, without cancellation
    return straight + amplitude * length * std::sin(phase + omega * (a + b) / 2) * sinc(omega * length / 2);
  return straight + amplitude * integral_of_chirp(phase, omega, chirp, a, b);
}

double Piece::area_of_area(double from, double to) const {
  if (curve) return curve->area_of_area(from, to);
  const double length = to - from, a = from - origin;
  const double straight = length * length * (level + slope * (a + length / 3)) / 2;
  if (amplitude == 0) return straight;
  if (chirp != 0) return straight + amplitude * area_of_chirp(phase, omega, chirp, a, to - origin);
  const double angle = phase + omega * a, turned = omega * length, half = sinc(turned / 2);
  return straight + amplitude * length * length * (std::sin(angle) * half * half / 2 + std::cos(angle) * lag_of_sine(turned));
}

double Piece::rounding(double t) const {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  if (integrated) {
    const double first = std::min(begin, t), last = std::max(begin, t);
    return numerics::signal_ulps * eps * (std::abs(begin_value) + largest_function(first, last) * (std::abs(t) + std::abs(begin)));
  }
  if (curve) return numerics::signal_ulps * eps * (curve->largest() + curve->largest_rate() * (std::abs(t) + std::abs(curve->first())));
  const double tau = std::abs(t - origin);
  const double angle = std::abs(phase) + (std::abs(omega) + std::abs(chirp) * tau / 2) * tau;
  const double fastest = std::abs(slope) + std::abs(amplitude) * (std::abs(omega) + std::abs(chirp) * tau);
  const double sizes = std::abs(level) + std::abs(slope) * tau + std::abs(amplitude) * (1 + angle) +
                       fastest * (std::abs(t) + std::abs(origin));
  return numerics::signal_ulps * eps * sizes;
}

double Piece::largest(double a, double b) const {
  if (!integrated) return largest_function(a, b);
  const double first = std::min(a, begin), last = std::max(b, begin);
  return std::abs(begin_value) + largest_function(first, last) * (last - first);
}

double Piece::largest_rate(double a, double b) const { return integrated ? largest_function(a, b) : largest_slope(a, b); }

double Piece::largest_function(double a, double b) const {
  if (curve) return curve->largest();
  return std::abs(level) + std::abs(slope) * std::max(std::abs(a - origin), std::abs(b - origin)) + std::abs(amplitude);
}

double Piece::largest_slope(double a, double b) const {
  if (curve) return curve->largest_rate();
  return std::abs(slope) + std::abs(amplitude) * spin(a, b);
}

double Piece::largest_curvature(double a, double b) const {
  if (integrated) return largest_slope(a, b);
  if (curve) return curve->largest_curvature();
  const double w = spin(a, b);
  return std::abs(amplitude) * (w * w + std::abs(chirp));
}

double Piece::largest_third(double a, double b) const {
  if (integrated) return integrand().largest_curvature(a, b);
  if (curve) return curve->largest_third();
  const double w = spin(a, b);
  return std::abs(amplitude) * (w * w + 3 * std::abs(chirp)) * w;
}

double Piece::fastest() const {
  // A sine has exactly this ratio of its largest rates.
  if (curve) return curve->largest_rate() > 0 ? curve->largest_curvature() / curve->largest_rate() : 0;
  return amplitude == 0 ? 0 : std::abs(omega) + std::sqrt(std::abs(chirp));
}

double Piece::spin(double a, double b) const {
  return std::abs(omega) + std::abs(chirp) * std::max(std::abs(a - origin), std::abs(b - origin));
}

}  // namespace rheonet
