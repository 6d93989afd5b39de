#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Limits the velocity tolerance of masses that pseudoplastic dashpots stop in a finite time. The slope of f = B w^n grows
/// without bound towards rest, so the same velocity error causes a growing error of the force, and of the time of rest. The
/// tolerance keeps the force within its own allowed error.
void Tolerances::find_stopping(const Dae::View& view) {
  if (!dae_->rough()) return;
  stopping_.assign(dae_->structure().kind.size(), std::numeric_limits<double>::infinity());
  for (const StopChain& chain : stop_chains_) {
    const double together = std::min(std::abs(view.velocity[at(chain.a)]), std::abs(view.velocity[at(chain.b)]));
    double most = 0, least = 0, dead_band = 0, largest_exponent = 0;
    for (const int r : chain.rates) {
      carried_seen_[at(r)] = std::max(carried_seen_[at(r)], together);
      dead_band = carried_noise(at(r));
      std::size_t i = 0;
      const RateBatch& law = network_.rate_of(r, i);
      const double n = law.growth(i).exponent, allowed = local() * dashpot_seen_[at(r)];
      const double w = std::abs(view.rate_velocity[at(r)]), f = std::abs(law.force_at(i, w));
      if (f > 0) most += allowed * w / (n * f);  // errors of velocities of the branches, by their slopes
      least += law.velocity_at(i, allowed);
      largest_exponent = std::max(largest_exponent, n);  // the slowest in the end
    }
    if (least == 0) continue;  // no force yet
    const double n = largest_exponent;
    const double steepening = n < 0.5 ? std::max(numerics::stopping_tightening, std::pow(numerics::stopping_time_share, (1 - 2 * n) / (1 - n))) : 1;
    most = std::max({steepening * most, least, dead_band});
    for (const NodeId node : {chain.a, chain.b}) stopping_[at(node)] = std::min(stopping_[at(node)], most);
  }
}

double Tolerances::carried_noise(std::size_t rate) const {
  return std::max(numerics::relative_motion_share * local(), numerics::relative_velocity_ulps * std::numeric_limits<double>::epsilon()) * carried_seen_[rate];
}

double Tolerances::unfelt(int rate) const {
  std::size_t i = 0;
  const auto [B, n] = network_.rate_of(rate, i).growth(i);
  const double largest = dashpot_seen_[at(rate)];
  if (largest == 0) return std::numeric_limits<double>::infinity();
  const double allowed = numerics::negligible_force * local() * largest, rounding = std::numeric_limits<double>::epsilon() * carried_seen_[at(rate)];
  // A steep law amplifies the round-off of the velocities of two ends that move together.
  return std::max({std::pow(allowed / B, 1 / n), std::pow(n * B * rounding / (numerics::negligible_force_noise * allowed), 1 / (1 - n)), numerics::negligible_force * carried_noise(at(rate))});
}

}  // namespace rheonet
