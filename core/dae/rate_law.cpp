#include "core/dae/rate_law.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet {

ConvexNetwork::Law rate_law(const RateBatch& batch, std::size_t i, double scale) {
  const double impulse = batch.impulse(i);
  if (batch.linear(i)) return {.backward = impulse, .forward = impulse};
  const double secant = scale / batch.velocity_at(i, scale);
  return {.backward = secant, .forward = secant, .beyond = [&batch, i](double w, double& slope) {
            const double f = batch.force_at(i, w);
            // The tangent of B |w|^n is n f/w, its secant f/w: the larger one never overshoots.
            slope = f / w * std::max(1.0, std::log2(batch.force_at(i, 2 * w) / f));
            return f;
          }};
}

Inputs::Reach coming_reach(const Inputs& inputs, const std::vector<double>& velocity) {
  Inputs::Reach reach = inputs.reach();
  for (const double v : velocity) reach.velocity = std::max(reach.velocity, std::abs(v));
  return reach;
}

double coming_force(const RateBatch& batch, std::size_t i, const Inputs::Reach& reach) {
  const double force = std::max(reach.force, batch.force_at(i, reach.velocity));
  return force > 0 ? force : 1;  // nothing ever moves: any value will do
}

}  // namespace rheonet
