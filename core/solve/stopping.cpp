#include "core/solve/stopping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

void Stopping::attach(const Dae& dae) {
  limit_.clear();
  chains_.clear();
  if (!dae.rough()) return;
  limit_.assign(dae.structure().kind.size(), std::numeric_limits<double>::infinity());
  chains_ = find_stop_chains(network_, dae.structure());
}

void Stopping::find(const Dae::View& view, const Magnitudes& seen, double local) {
  std::fill(limit_.begin(), limit_.end(), std::numeric_limits<double>::infinity());
  for (const StopChain& chain : chains_) {
    const double common = std::min(std::abs(view.velocity[at(chain.a)]), std::abs(view.velocity[at(chain.b)]));
    const double together = std::max({common, carried_by_trains(chain.a, view.velocity), carried_by_trains(chain.b, view.velocity)});
    double most = 0, least = 0, dead_band = 0, largest_exponent = 0;
    for (const int r : chain.rates) {
      carried_seen_[at(r)] = std::max(carried_seen_[at(r)], together);
      dead_band = carried_noise(at(r), local);
      std::size_t i = 0;
      const RateBatch& law = network_.rate_of(r, i);
      const double n = law.growth(i).exponent, allowed = local * seen.dashpot[at(r)];
      const double w = std::abs(view.rate_velocity[at(r)]), f = std::abs(law.force_at(i, w));
      if (f > 0) most += allowed * w / (n * f);  // errors of velocities of the branches, by their slopes
      least += law.velocity_at(i, allowed);
      largest_exponent = std::max(largest_exponent, n);  // the slowest in the end
    }
    if (least == 0) continue;  // no force yet
    const double n = largest_exponent;
    const double steepening = n < 0.5 ? std::max(numerics::stopping_tightening, std::pow(numerics::stopping_time_share, (1 - 2 * n) / (1 - n))) : 1;
    most = std::max({steepening * most, least, dead_band});
    for (const NodeId node : {chain.a, chain.b}) limit_[at(node)] = std::min(limit_[at(node)], most);
  }
}

/// The largest part of a node's velocity that another node of a transmission gives it: such parts may cancel.
double Stopping::carried_by_trains(NodeId node, const std::vector<double>& velocity) const {
  double largest = 0;
  for (const Network::Train& train : network_.trains) {
    const auto own = std::find(train.node.begin(), train.node.end(), node);
    if (own == train.node.end() || train.factor[at(own - train.node.begin())] == 0) continue;
    for (std::size_t k = 0; k < train.node.size(); ++k) {
      if (train.node[k] != node) largest = std::max(largest, std::abs(train.factor[k] / train.factor[at(own - train.node.begin())] * velocity[at(train.node[k])]));
    }
  }
  return largest;
}

double Stopping::carried_noise(std::size_t rate, double local) const {
  return std::max(numerics::relative_motion_share * local, numerics::relative_velocity_ulps * std::numeric_limits<double>::epsilon()) * carried_seen_[rate];
}

double Stopping::unfelt(int rate, const Magnitudes& seen, double local) const {
  std::size_t i = 0;
  const auto [B, n] = network_.rate_of(rate, i).growth(i);
  const double largest = seen.dashpot[at(rate)];
  if (largest == 0) return std::numeric_limits<double>::infinity();
  const double allowed = numerics::negligible_force * local * largest, rounding = std::numeric_limits<double>::epsilon() * carried_seen_[at(rate)];
  // A steep law amplifies the round-off of the velocities of two ends that move together.
  return std::max({std::pow(allowed / B, 1 / n), std::pow(n * B * rounding / (numerics::negligible_force_noise * allowed), 1 / (1 - n)), numerics::negligible_force * carried_noise(at(rate), local)});
}

}  // namespace rheonet
