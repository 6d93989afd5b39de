#pragma once

#include <string>

namespace rheonet {

/// Exponents of the SI base units of a mechanical quantity. Radians count as pure numbers. Exponents are real, because the
/// damping of a power-law dashpot has the unit N (s/m)^n.
struct Dimension {
  double metre = 0;
  double kilogram = 0;
  double second = 0;

  friend Dimension operator*(Dimension a, Dimension b) {
    return {a.metre + b.metre, a.kilogram + b.kilogram, a.second + b.second};
  }
  friend Dimension operator/(Dimension a, Dimension b) { return a * b.power(-1); }
  Dimension power(double n) const { return {n * metre, n * kilogram, n * second}; }
  bool is_number() const { return same(Dimension{}); }
  /// Equal within 1e-9, which covers the round-off of fractional exponents.
  bool same(Dimension other) const;
};

/// Translation: positions in m, forces in N, masses in kg. Rotation: angles in rad, torques in N*m, inertias in kg*m^2.
enum class Domain : char { translation, rotation };

/// The kind of quantity that a netlist value represents; its dimension depends on the domain.
enum class Quantity {
  number,     ///< Dimensionless.
  time,       ///< [s].
  frequency,  ///< Hz (cycles a second); a unit with rad is an angular frequency and is divided by 2 pi.
  angle,      ///< rad in both domains (the phase of a signal).
  position,   ///< m | rad; displacements too.
  length,     ///< m in both domains (the radius of a pinion).
  velocity,   ///< m/s | rad/s.
  force,      ///< N | N*m.
  stiffness,  ///< N/m | N*m/rad.
  damping,    ///< N*(s/m)^n | N*m*(s/rad)^n, n the value of the parameter's flow index.
  mass,       ///< kg | kg*m^2.
  acceleration,  ///< m/s^2 | rad/s^2.
  power,         ///< W
  energy,        ///< J
};

/// The dimension of `quantity`. `flow_index` is n above; it matters for damping only.
Dimension dimension_of(Quantity quantity, Domain domain, double flow_index = 1);

/// The name used in messages: "stiffness", or "torque" for a force in a rotational scene, ...
std::string name_of(Quantity quantity, Domain domain);

/// The SI unit as a user would type it: "N/m", "N*m/rad", "N*(s/m)^0.5"; "1" for a number.
std::string unit_of(Quantity quantity, Domain domain, double flow_index = 1);

/// A dimension without a quantity, for error texts: "kg*m^2*s^-2".
std::string to_string(Dimension dimension);

/// The dimension in words, if it has a name: "a torque or an energy (N*m)". `radian` is the exponent of rad, which
/// distinguishes an angular velocity from a frequency.
std::string describe(Dimension dimension, double radian = 0);
/// The SI unit of a dimension, "N*m"; "" for a number.
std::string unit_of(Dimension dimension, double radian);

}  // namespace rheonet
