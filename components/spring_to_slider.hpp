#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"

namespace rheonet {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// For laws that start as a spring and flow as a slider: the error of a start force f0 [N; NaN: not given] beyond the bound
/// Fc [N]; absent if f0 is valid.
inline std::optional<Misfit> beyond_bound(double f0, double Fc) {
  if (std::isnan(f0) || std::abs(f0) <= Fc) return {};
  return Misfit{"f0", "lies beyond `coulomb`: a force that it cannot have"};
}

/// The error of parameters of which signals give some: another one is infinite, or there is a start force f0 [N] without a constant
/// stiffness sigma [N/m].
inline std::optional<Misfit> misfit_of_varying(std::initializer_list<std::pair<const char*, double>> parameters, double sigma, double f0) {
  for (const auto& [name, value] : parameters) {
    if (std::isinf(value)) return Misfit{name, "must be finite where another parameter varies"};
  }
  if (std::isnan(sigma) && !std::isnan(f0) && f0 != 0) return Misfit{"f0", "needs a constant `stiffness`: with one that varies the element starts without force"};
  return {};
}

/// Deflection at the start of a law with parameters that vary [m].
inline double start_of_varying(double sigma, double f0) { return std::isnan(sigma) || std::isnan(f0) ? 0 : f0 / sigma; }

/// Solid friction with parameters that vary, where the deflection z changes with the velocity `rate`: z' = u^i rate.
inline VaryingLaw varying_solid_friction(const std::string& rate, double sigma, double f0) {
  // (u^2)^(i/2) in place of abs(u)^i: abs keeps its side until the event at which u changes its sign.
  const std::string u = "(1 - sign(w)*stiffness*z/coulomb)";
  return {.force = "stiffness*z", .stored = "stiffness*z^2/2",
          .states = {{"z", "sign(" + u + ")*(" + u + "^2)^(exponent/2)*(" + rate + ")", start_of_varying(sigma, f0)}}};
}

/// Below 1 the bound is reached in finite time, as an event of a law whose bound is constant.
inline std::optional<Misfit> misfit_of_exponent(double exponent) {
  if (exponent >= 1) return {};
  return Misfit{"exponent", "must be at least 1 where another parameter varies"};
}

/// Values of a `spring` of stiffness sigma [N/m] that starts with the force f0 [N; NaN: 0].
inline std::vector<double> as_spring(double sigma, double f0) {
  return {sigma, 0, std::isnan(f0) ? 0 : f0, not_given};
}

/// The same check for laws with the parameters stiffness, coulomb, a shape parameter and f0.
inline std::optional<Misfit> start_within_bound(std::span<const double> v) { return beyond_bound(v[3], v[1]); }

/// Effects of such a law: without dry friction it has no force, without elasticity it is rigid up to its bound.
inline std::vector<Brought> friction_effects() {
  return {{Effect::dry_friction, "coulomb", 0}, {Effect::elasticity, "stiffness", infinity}};
}

/// The limits of such a law for any shape, followed by `others`.
inline std::vector<Limit> spring_to_slider(std::vector<Limit> others = {}) {
  std::vector<Limit> limits = {
      {.when = "stiffness = 0 or coulomb = 0", .becomes = "",
       .applies = [](std::span<const double> v) { return v[0] == 0 || v[1] == 0; },
       .values = {}},
      {.when = "stiffness = inf", .becomes = "slider",
       .applies = [](std::span<const double> v) { return std::isinf(v[0]); },
       .values = [](std::span<const double> v) { return std::vector<double>{v[1], v[1]}; }},
      {.when = "coulomb = inf", .becomes = "spring",
       .applies = [](std::span<const double> v) { return std::isinf(v[1]); },
       .values = [](std::span<const double> v) { return as_spring(v[0], v[3]); }}};
  limits.insert(limits.end(), others.begin(), others.end());
  return limits;
}

}  // namespace rheonet
