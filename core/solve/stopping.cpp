#include <algorithm>
#include <cmath>
#include <limits>

#include "core/network/index.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

namespace {

// Below n = 1/2 the force of w(t) = (c (T - t))^(1/(1-n)) falls ever more steeply, and an error of the time of rest T makes the
// more of it the nearer that is: as much as is allowed at this share of the motion before it, but for laws that are as good as
// dry friction, whose force falls at one instant.
constexpr double last_share = 3e-3, most_steepening = 1 / 30.0;
// Of the velocity with which both ends move along together, to how much their difference is resolved at best: in shares of what
// they are themselves, and in roundings.
constexpr double least_share = 1e-5, carried_grains = 256;
// Noise of a force is borne up to about the accuracy promised: more would keep steps from converging.
constexpr double noisy = 10;

}  // namespace

/// A pseudoplastic dashpot between masses, or a mass and what moves as it is given to, brings them to rest at a finite time:
/// f = B w^n, with a slope without bound in the end. The same error of a velocity w there is a larger one of the force, and a
/// larger one of the time of rest: each is to leave the force right.
void Tolerances::find_stopping(const Dae::View& view) {
  if (!dae_->rough()) return;
  const Structure& structure = dae_->structure();
  stopping_.assign(structure.kind.size(), std::numeric_limits<double>::infinity());
  const auto heavy = [&](NodeId node) { return structure.kind[at(node)] == Kind::known || structure.kind[at(node)] == Kind::massive; };
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const Branch& b = structure.rates[r];
      const double n = laws.batch->growth(i).exponent, largest = dashpot_seen_[r];
      if (n >= 1 || b.a == b.b || !heavy(b.a) || !heavy(b.b)) continue;
      const double w = std::abs(view.rate_velocity[r]);
      const double together = std::min(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
      carried_seen_[r] = std::max(carried_seen_[r], together);
      if (!(unfelt(static_cast<int>(r)) < std::numeric_limits<double>::infinity())) continue;
      const double f = std::abs(laws.batch->force_at(i, w)), allowed = local() * largest;
      const double steepening = n < 0.5 ? std::max(most_steepening, std::pow(last_share, (1 - 2 * n) / (1 - n))) : 1;
      const double by_slope = f > 0 ? steepening * allowed * w / (n * f) : 0;
      const double most = std::max({by_slope, laws.batch->velocity_at(i, allowed), carried_noise(r)});
      for (const NodeId node : {b.a, b.b}) stopping_[at(node)] = std::min(stopping_[at(node)], most);
    }
  }
}

double Tolerances::carried_noise(std::size_t rate) const {
  return std::max(least_share * local(), carried_grains * std::numeric_limits<double>::epsilon()) * carried_seen_[rate];
}

double Tolerances::unfelt(int rate) const {
  std::size_t i = 0;
  const auto [B, n] = network_.rate_of(rate, i).growth(i);
  const double largest = dashpot_seen_[at(rate)];
  if (largest == 0) return std::numeric_limits<double>::infinity();
  const double allowed = soft_share * local() * largest, rounding = std::numeric_limits<double>::epsilon() * carried_seen_[at(rate)];
  // The steeper the law is, the more is made of the rounding of two velocities by which both ends move along together.
  return std::max({std::pow(allowed / B, 1 / n), std::pow(n * B * rounding / (noisy * allowed), 1 / (1 - n)), soft_share * carried_noise(at(rate))});
}

}  // namespace rheonet
