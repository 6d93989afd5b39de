#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/network/component.hpp"

namespace rheonet {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// For laws that begin as a spring and come to flow as a slider: why a force f0 at the start [N; NaN: not given] cannot
/// be, if it lies beyond the bound Fc [N].
inline std::optional<Misfit> beyond_bound(double f0, double Fc) {
  if (std::isnan(f0) || std::abs(f0) <= Fc) return {};
  return Misfit{"f0", "lies beyond `coulomb`: a force that it cannot have"};
}

/// Values of the `spring` of stiffness sigma [N/m] with which a law begins at the force f0 [N; NaN: 0].
inline std::vector<double> as_spring(double sigma, double f0) {
  return {sigma, 0, std::isnan(f0) ? 0 : f0, not_given};
}

/// The same where the law's parameters are stiffness, coulomb, one for its shape, f0.
inline std::optional<Misfit> start_within_bound(std::span<const double> v) { return beyond_bound(v[3], v[1]); }

/// Its effects: without friction there is no force, without elasticity it is rigid up to its bound.
inline std::vector<Brought> friction_effects() {
  return {{Effect::dry_friction, "coulomb", 0}, {Effect::elasticity, "stiffness", infinity}};
}

/// The limits that such a law has whatever its shape is; `others` follow them.
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
