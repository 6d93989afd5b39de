#include "core/netlist/dimension.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rheonet {

namespace {

// Equal exponents differ by the round-off of a few products; different exponents differ by more than the precision with
// which flow indices are typed.
constexpr double exponent_tolerance = 1e-9;

bool near(double a, double b) { return std::abs(a - b) <= exponent_tolerance; }

std::string damping_unit(Domain domain, double n) {
  const bool rotation = domain == Domain::rotation;
  const std::string force = rotation ? "N*m" : "N";
  if (near(n, 0)) return force;
  if (near(n, 1)) return force + (rotation ? "*s/rad" : "*s/m");
  return fmt::format("{}*(s/{})^{:.12g}", force, rotation ? "rad" : "m", n);
}

}  // namespace

bool Dimension::same(Dimension other) const {
  return near(metre, other.metre) && near(kilogram, other.kilogram) && near(second, other.second);
}

Dimension dimension_of(Quantity quantity, Domain domain, double flow_index) {
  const Dimension time{0, 0, 1};
  const Dimension length = domain == Domain::rotation ? Dimension{} : Dimension{1, 0, 0};
  const Dimension mass = domain == Domain::rotation ? Dimension{2, 1, 0} : Dimension{0, 1, 0};
  const Dimension force = domain == Domain::rotation ? Dimension{2, 1, -2} : Dimension{1, 1, -2};
  switch (quantity) {
    case Quantity::number:
    case Quantity::angle:
      return {};
    case Quantity::time:
      return time;
    case Quantity::frequency:
      return time.power(-1);
    case Quantity::position:
      return length;
    case Quantity::length:
      return {1, 0, 0};
    case Quantity::velocity:
      return length / time;
    case Quantity::force:
      return force;
    case Quantity::stiffness:
      return force / length;
    case Quantity::damping:
      return force * (time / length).power(flow_index);
    case Quantity::mass:
      return mass;
    case Quantity::acceleration:
      return length / time.power(2);
    case Quantity::power:
      return force * length / time;
    case Quantity::energy:
      return force * length;
  }
  return {};
}

std::string name_of(Quantity quantity, Domain domain) {
  const bool rotation = domain == Domain::rotation;
  switch (quantity) {
    case Quantity::number:
      return "number";
    case Quantity::time:
      return "time";
    case Quantity::frequency:
      return "frequency";
    case Quantity::angle:
      return "angle";
    case Quantity::position:
      return rotation ? "angle" : "length";
    case Quantity::length:
      return "length";
    case Quantity::velocity:
      return rotation ? "angular velocity" : "velocity";
    case Quantity::force:
      return rotation ? "torque" : "force";
    case Quantity::stiffness:
      return rotation ? "torsional stiffness" : "stiffness";
    case Quantity::damping:
      return rotation ? "torsional damping" : "damping";
    case Quantity::mass:
      return rotation ? "moment of inertia" : "mass";
    case Quantity::acceleration:
      return rotation ? "angular acceleration" : "acceleration";
    case Quantity::power:
      return "power";
    case Quantity::energy:
      return "energy";
  }
  return {};
}

std::string unit_of(Quantity quantity, Domain domain, double flow_index) {
  const bool rotation = domain == Domain::rotation;
  switch (quantity) {
    case Quantity::number:
      return "1";
    case Quantity::time:
      return "s";
    case Quantity::frequency:
      return "Hz";
    case Quantity::angle:
      return "rad";
    case Quantity::position:
      return rotation ? "rad" : "m";
    case Quantity::length:
      return "m";
    case Quantity::velocity:
      return rotation ? "rad/s" : "m/s";
    case Quantity::force:
      return rotation ? "N*m" : "N";
    case Quantity::stiffness:
      return rotation ? "N*m/rad" : "N/m";
    case Quantity::damping:
      return damping_unit(domain, flow_index);
    case Quantity::mass:
      return rotation ? "kg*m^2" : "kg";
    case Quantity::acceleration:
      return rotation ? "rad/s^2" : "m/s^2";
    case Quantity::power:
      return "W";
    case Quantity::energy:
      return "J";
  }
  return {};
}

std::string to_string(Dimension dimension) {
  std::string text;
  const auto append = [&text](const char* base, double exponent) {
    if (near(exponent, 0)) return;
    if (!text.empty()) text += '*';
    text += base;
    if (near(exponent, 1)) return;
    // Rounded to the tolerance, so that 2.9999999999 is printed as 3.
    text += fmt::format("^{:.9g}", std::round(exponent / exponent_tolerance) * exponent_tolerance);
  };
  append("kg", dimension.kilogram);
  append("m", dimension.metre);
  append("s", dimension.second);
  return text.empty() ? "1" : text;
}

namespace {

/// A dimension that has a name, with the exponent of rad that goes with it.
struct NamedDimension {
  Dimension dimension;
  double radian;
  const char *name, *unit;
};

const NamedDimension* find_named(Dimension dimension, double radian) {
  static constexpr NamedDimension known[] = {
      {{0, 0, 0}, 0, "a pure number", ""},
      {{0, 0, 0}, 1, "an angle", "rad"},
      {{1, 0, 0}, 0, "a length", "m"},
      {{2, 0, 0}, 0, "an area", "m^2"},
      {{3, 0, 0}, 0, "a volume", "m^3"},
      {{0, 0, 1}, 0, "a time", "s"},
      {{0, 0, -1}, 0, "a frequency", "1/s"},
      {{0, 0, -1}, 1, "an angular velocity", "rad/s"},
      {{0, 0, -2}, 1, "an angular acceleration", "rad/s^2"},
      {{1, 0, -1}, 0, "a velocity", "m/s"},
      {{1, 0, -2}, 0, "an acceleration", "m/s^2"},
      {{0, 1, 0}, 0, "a mass", "kg"},
      {{2, 1, 0}, 0, "a moment of inertia", "kg*m^2"},
      {{1, 1, -2}, 0, "a force", "N"},
      {{2, 1, -2}, 0, "a torque or an energy", "N*m"},
      {{2, 1, -2}, -1, "a torsional stiffness", "N*m/rad"},
      {{2, 1, -1}, -1, "a torsional damping", "N*m*s/rad"},
      {{2, 1, -1}, 0, "an angular momentum", "N*m*s"},
      {{2, 1, -3}, 0, "a power", "W"},
      {{0, 1, -2}, 0, "a stiffness", "N/m"},
      {{0, 1, -1}, 0, "a damping", "N*s/m"},
      {{-1, 1, -2}, 0, "a pressure", "Pa"},
      {{-1, 1, -1}, 0, "a dynamic viscosity", "Pa*s"},
      {{2, 0, -1}, 0, "a kinematic viscosity", "m^2/s"},
      {{-3, 1, 0}, 0, "a density", "kg/m^3"},
  };
  // An exponent of rad that gives no name of its own (N*rad) is ignored.
  for (const double wanted : {radian, 0.0})
    for (const auto& entry : known)
      if (dimension.same(entry.dimension) && near(entry.radian, wanted)) return &entry;
  return nullptr;
}

}  // namespace

std::string describe(Dimension dimension, double radian) {
  const NamedDimension* named = find_named(dimension, radian);
  if (!named) return "a quantity in " + to_string(dimension);
  const std::string unit = named->unit;
  return named->name + (unit.empty() ? "" : " (" + unit + ")");
}

std::string unit_of(Dimension dimension, double radian) {
  const NamedDimension* named = find_named(dimension, radian);
  return named ? named->unit : to_string(dimension);
}

}  // namespace rheonet
