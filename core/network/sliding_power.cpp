#include "core/network/sliding_power.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"

namespace rheonet {

Dual SlidingPower::force(std::span<const double> arguments, int by) const {
  const int side = arguments[0] < 0 ? -1 : 1;
  // A freewheel does not move backwards. A small velocity that way is the error of the event at which it stops.
  const auto finite = [](const Dual& bound) { return std::isinf(bound.value) ? Dual(0) : bound; };
  if (varying_.empty()) return finite(box_.at(side).sliding);
  std::vector<Dual> values(values_.begin(), values_.end());
  for (std::size_t k = 0; k < varying_.size(); ++k) {
    values[at(varying_[k].parameter)] = {arguments[k + 1], static_cast<int>(k) == by ? 1.0 : 0.0};
  }
  return finite(component_->box(values).at(side).sliding);
}

std::optional<double> SlidingPower::value(std::span<const double> arguments, std::span<const double>) const {
  if (arguments[0] == 0) return 0;  // however large the friction
  const double power = std::abs(arguments[0]) * force(arguments, -1).value;
  return std::isfinite(power) ? std::optional(power) : std::nullopt;
}

std::optional<double> SlidingPower::value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const {
  std::fill(partials.begin(), partials.end(), 0.0);
  const double speed = std::abs(arguments[0]);
  if (speed == 0) return 0;
  partials[0] = std::copysign(force(arguments, -1).value, arguments[0]);
  for (std::size_t k = 0; k < varying_.size(); ++k) partials[k + 1] = speed * force(arguments, static_cast<int>(k)).derivative;
  return value(arguments, sides);
}

}  // namespace rheonet
