#include "core/solve/stopping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

bool moved(const Network::Train& train, std::size_t k) { return train.node[k] != ground && train.factor[k] != 0; }

}  // namespace

void Stopping::attach(const Dae& dae) {
  limit_.clear();
  chains_.clear();
  geared_.clear();
  cancelling_.clear();
  if (!dae.rough()) return;
  limit_.assign(dae.structure().kind.size(), std::numeric_limits<double>::infinity());
  chains_ = find_stop_chains(network_, dae.structure());
  find_geared(dae.structure());
}

void Stopping::find_geared(const Structure& structure) {
  const auto head = [&](const Network::Train& train, std::size_t k) { return structure.rigid[at(train.node[k])]; };
  std::map<NodeId, std::vector<std::pair<const Network::Train*, std::size_t>>> trains_at;
  for (const Network::Train& train : network_.trains) {
    for (std::size_t k = 0; k < train.node.size(); ++k) {
      if (moved(train, k)) trains_at[head(train, k)].emplace_back(&train, k);
    }
  }
  for (const auto& [first, unused] : trains_at) {
    if (geared_.contains(first)) continue;
    const std::size_t group = cancelling_.size();
    cancelling_.push_back(0);
    geared_[first] = {group, 1};
    std::vector<NodeId> reached{first};
    for (std::size_t r = 0; r < reached.size(); ++r) {
      for (const auto& [train, own] : trains_at[reached[r]]) {
        if (moved(*train, 0) && moved(*train, 1) && moved(*train, 2)) cancelling_[group] = 1;
        for (std::size_t k = 0; k < train->node.size(); ++k) {
          if (!moved(*train, k) || geared_.contains(head(*train, k))) continue;
          geared_[head(*train, k)] = {group, geared_[reached[r]].scale * std::abs(train->factor[k] / train->factor[own])};
          reached.push_back(head(*train, k));
        }
      }
    }
  }
}

void Stopping::find(const Dae::View& view, const Magnitudes& seen, double local) {
  std::fill(limit_.begin(), limit_.end(), std::numeric_limits<double>::infinity());
  std::vector<double> fastest(cancelling_.size(), 0);
  for (const auto& [node, geared] : geared_) {
    if (cancelling_[geared.group]) fastest[geared.group] = std::max(fastest[geared.group], geared.scale * std::abs(view.velocity[at(node)]));
  }
  // A velocity has the round-off of those from which it follows.
  const auto carried = [&](NodeId node) {
    const auto geared = geared_.find(node);
    return geared == geared_.end() ? 0 : fastest[geared->second.group] / geared->second.scale;
  };
  for (const StopChain& chain : chains_) {
    const double common = std::min(std::abs(view.velocity[at(chain.a)]), std::abs(view.velocity[at(chain.b)]));
    const double together = std::max({common, carried(chain.a), carried(chain.b)});
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
