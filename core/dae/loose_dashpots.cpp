#include "core/dae/loose_dashpots.hpp"

#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

LooseDashpots::LooseDashpots(const Network& network, const Structure& structure, const std::vector<int>& solved) : structure_(&structure) {
  std::vector<int> place(structure.kind.size(), -1);
  const auto massless = [&](NodeId node) { return structure.kind[at(node)] == Kind::viscous; };
  const auto place_of = [&](NodeId node) {
    if (massless(node) && place[at(node)] < 0) {
      place[at(node)] = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
    }
    return place[at(node)];
  };
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const Branch& b = structure.rates[r];
      const double damping = laws.batch->impulse(i);
      if (solved[r] >= 0 || b.a == b.b || !(damping > 0) || !std::isfinite(damping) || !(massless(b.a) || massless(b.b))) continue;
      const int a = place_of(b.a), c = place_of(b.b);
      dashpots_.push_back({r, a, c, damping});
    }
  }
  for (std::size_t k = 0; k < nodes_.size(); ++k) conductances_.push_back({static_cast<int>(k), -1, 0});
  for (const Dashpot& one : dashpots_) conductances_.push_back({one.a, one.b, 0});
  potential_.resize(static_cast<Eigen::Index>(nodes_.size()));
  rounding_.resize(dashpots_.size());
  change_.resize(dashpots_.size());
  network_ = ConductanceNetwork(conductances_, potential_.size());
}

double LooseDashpots::roundoff_of(const Dashpot& dashpot, const Nodes& nodes) const {
  const Branch& b = structure_->rates[dashpot.rate];
  return numerics::newton_velocity_ulps * std::numeric_limits<double>::epsilon() * dashpot.damping * (std::abs(nodes.velocity[at(b.a)]) + std::abs(nodes.velocity[at(b.b)]));
}

void LooseDashpots::balance(const Nodes& nodes, std::vector<double>& rate_force, std::vector<double>& nodal) {
  bool balanced = true;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t n = at(nodes_[k]);
    const double imbalance = nodal[n] - nodes.applied[n];
    const double rounding = numerics::sum_ulps * std::numeric_limits<double>::epsilon() * (nodes.magnitude[n] + std::abs(nodes.applied[n]));
    potential_[static_cast<Eigen::Index>(k)] = -imbalance;
    conductances_[k].value = rounding * rounding;
    balanced = balanced && std::abs(imbalance) <= rounding;
  }
  if (balanced) return;
  for (std::size_t k = 0; k < dashpots_.size(); ++k) {
    rounding_[k] = roundoff_of(dashpots_[k], nodes);
    conductances_[nodes_.size() + k].value = rounding_[k] * rounding_[k];
  }
  if (!network_.solve(conductances_, potential_)) return;
  const auto at_node = [&](int place) { return place < 0 ? 0 : potential_[place]; };
  for (std::size_t k = 0; k < dashpots_.size(); ++k) {
    change_[k] = rounding_[k] * rounding_[k] * (at_node(dashpots_[k].a) - at_node(dashpots_[k].b));
    if (!(std::abs(change_[k]) <= rounding_[k])) return;
  }
  for (std::size_t k = 0; k < dashpots_.size(); ++k) {
    const Branch& b = structure_->rates[dashpots_[k].rate];
    rate_force[dashpots_[k].rate] += change_[k];
    nodal[at(b.a)] += change_[k];
    nodal[at(b.b)] -= change_[k];
  }
}

}  // namespace rheonet
