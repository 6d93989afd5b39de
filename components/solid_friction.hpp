#pragma once

#include <cmath>
#include <span>
#include <utility>

#include "core/network/dual.hpp"

namespace rheonet {

/// Dahl's solid friction between two reversals, in closed form (P. L. Dahl 1982, Eqs. 8-11, 18). The law
///
///     df/dp = E = sigma |u|^i sgn u,   u = 1 - s f/Fc,   s the direction of motion (a constant between reversals)
///
/// depends on f alone, so that f is a function of the deflection p alone. With x = s (p - p_ref) and q = 1 - i:
///
///     u^q = u_ref^q - q sigma x/Fc    (i = 1: u = u_ref exp(-sigma x/Fc)),     f = s Fc (1 - u),   0 <= u <= 2
///
/// For i < 1 the force reaches the bound u = 0 at a finite x, and is then `held` at s Fc until it is released.
struct SolidFriction {
  /// Fraction of the bound: a force closer to the bound is set to the bound, because the difference is round-off.
  static constexpr double yield_rounding = 1e-15;

  double sigma;  ///< N/m
  double Fc;     ///< N
  double i;      ///< exponent

  // Memory: constant between events.
  double s = 1;
  double p_ref = 0;  ///< m
  double f_ref = 0;  ///< N, at p_ref
  double u_ref = 1;  ///< 1 - s f_ref/Fc
  bool held = false;

  /// Force at deflection p [N]; |force| <= Fc for all states of the law.
  template <class T>
  T force(const T& p) const {
    using std::expm1, std::log1p, std::pow;
    if (held) return T(s * Fc);
    if (i == 0) {
      // A straight line up to the bound and beyond, so that a step past the bound can return to the yield point.
      const T f = f_ref + sigma * (p - p_ref);
      return std::abs(s * value_of(f) - Fc) <= yield_rounding * Fc ? T(f + (s * Fc - value_of(f))) : f;
    }
    const double q = 1 - i;
    const T z = (sigma / Fc * s) * (p - p_ref);
    if (u_ref == 0) {  // at the bound: leaves it backwards (i < 1) or stays there (i >= 1)
      if (i >= 1 || value_of(z) >= 0) return T(s * Fc);
      const T u = pow(T(-q * z), 1 / q);
      return value_of(u) < 2 ? T(s * Fc * (1 - u)) : beyond(z, -std::pow(2, q) / q);
    }
    // At u = 2 the force is -s Fc, the last state of the law. Solver iterates may pass it: continue along the tangent.
    const double z2 = q == 0 ? std::log(u_ref / 2) : (std::pow(u_ref, q) - std::pow(2, q)) / q;
    if (value_of(z) < z2) return beyond(z, z2);
    const T y = z * std::pow(u_ref, -q);
    if (q * value_of(y) >= 1) return T(s * Fc);
    // Computed relative to f_ref, so that a small force keeps all its digits.
    const T f = f_ref - (s * Fc * u_ref) * expm1(q == 0 ? T(-y) : T(log1p(T(-q * y)) / q));
    return s * value_of(f) < Fc ? f : T(s * Fc);
  }

  /// Force after a deflection made in one step, without an event at the bound; limited to the bound.
  template <class T>
  T force_reached(const T& p) const {
    const T f = force(p);
    return s * value_of(f) > Fc ? T(s * Fc) : f;
  }

  /// Slope df/dp at deflection p at the beginning of a motion in `direction`.
  double slope_along(double p, int direction) const {
    const double u = 1 - direction * force(p) / Fc;
    return u > 0 ? sigma * std::pow(u, i) : 0;
  }
  bool constant() const { return held; }

  int direction() const { return s < 0 ? -1 : s > 0 ? 1 : 0; }

  /// Deflection travelled since p_ref at which the bound is reached; infinite for i >= 1.
  double travel_to_bound() const {
    return i < 1 ? Fc / sigma * std::pow(u_ref, 1 - i) / (1 - i) : std::numeric_limits<double>::infinity();
  }

  /// Begins a new branch at deflection p in `direction`; the force does not change.
  void turn(double p, double direction) {
    begin(p, force(p), direction);
  }

  /// Begins a branch in `direction` at deflection p with force f.
  void begin(double p, double f, double direction) {
    s = direction;
    p_ref = p;
    f_ref = f;
    u_ref = std::max(0.0, 1 - s * f / Fc);
    held = i < 1 && u_ref <= 0;
  }

  double recentre(double p) { return p == p_ref ? std::exchange(p_ref, 0) : 0; }

  /// The deflection jumps from p to p + jump along the law. Returns the heat.
  double jump(double p, double jump) {
    if (jump == 0) return 0;
    const double direction = jump < 0 ? -1 : 1;
    if (direction != s) turn(p, direction);
    // Work along the curve by the midpoint rule, accurate to 1e-6 of it; used in the energy account alone.
    constexpr int slices = 1000;
    double work = 0;
    for (int k = 0; k < slices; ++k) work += force_reached(p + jump * (k + 0.5) / slices) * jump / slices;
    const double before = stored_energy(p);
    held = held || (i < 1 && s * (p + jump - p_ref) >= travel_to_bound());
    return work - (stored_energy(p + jump) - before);
  }

  /// Elastically bent bristles store f^2/(2 sigma); the rest of the work f dp becomes heat: f w (1 - u^i) >= 0.
  double stored_energy(double p) const {
    const double f = force(p);
    return f * f / (2 * sigma);
  }
  double heating(double p, double w) const {
    const double f = force(p);
    const double u = 1 - s * f / Fc;
    return f * w * (1 - (held ? 0 : std::pow(std::max(u, 0.0), i)));
  }

 private:
  template <class T>
  T beyond(const T& z, double z2) const {
    return T(s * Fc * (-1 + std::pow(2, i) * (z - z2)));
  }
};

}  // namespace rheonet
