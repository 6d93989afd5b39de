// Laws of elements in the convex problem of a mode selection.
#include <algorithm>
#include <cmath>

#include "core/dae/event_transition.hpp"

namespace rheonet {

/// Friction at its bound: it leaves the bound with this slope at velocities below its creep, and keeps its force above.
ConvexNetwork::Law EventTransition::released(ConvexNetwork::Law law, double slope, double creep) {
  const double side = creep > 0 ? 1 : -1;
  (side > 0 ? law.high : law.low) = -slope * creep;
  (side > 0 ? law.forward : law.backward) = slope;
  const ConvexNetwork::Law other = law;
  law.beyond = [=](double w, double& tangent) {
    if (w * side < 0) {
      tangent = side > 0 ? other.backward : other.forward;
      return (side > 0 ? other.low : other.high) + tangent * w;
    }
    tangent = std::abs(w) < std::abs(creep) ? slope : 0;
    return side * slope * std::min(0.0, std::abs(w) - std::abs(creep));
  };
  return law;
}

/// Change of the force of a rate law when the velocity changes from w0. A law without a finite slope there gets one that leads
/// away, towards forces of about `scale` [N]. Slopes above `steepest` [N s/m] are treated as rigid, and replaced by it.
ConvexNetwork::Law EventTransition::law_of(const RateBatch& batch, std::size_t i, double w0, double scale, double steepest) {
  const double impulse = batch.impulse(i);
  if (batch.linear(i)) return {.backward = impulse, .forward = impulse, .of_change = true};
  const Growth growth = batch.growth(i);
  const double rigid = growth.exponent < 1 ? std::pow(growth.coefficient / steepest, 1 / (1 - growth.exponent)) : 0;
  const auto force = [&batch, i, rigid, steepest](double w) {
    return std::abs(w) < rigid ? steepest * w : batch.force_at(i, w);
  };
  // The tangent of B |w|^n is n f/w, its secant f/w: the larger one never overshoots.
  const auto steeper = [force](double w, double f) { return f == 0 ? 0 : f / w * std::max(1.0, std::log2(force(2 * w) / f)); };
  const double f0 = force(w0), slope = w0 != 0 ? steeper(w0, f0) : std::min(steepest, scale / batch.velocity_at(i, scale));
  return {.backward = slope, .forward = slope, .rounding = std::abs(f0), .of_change = true,
          .beyond = [force, w0, f0, slope, steeper](double change, double& tangent) {
            const double w = w0 + change, f = force(w);
            tangent = w != 0 ? steeper(w, f) : slope;
            return f - f0;
          }};
}

}  // namespace rheonet
