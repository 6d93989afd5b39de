#include "core/dae/loose_dashpots.hpp"

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/nonsmooth/conductances.hpp"

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
}

double LooseDashpots::roundoff_of(const Dashpot& dashpot, const Nodes& nodes) const {
  const Branch& b = structure_->rates[dashpot.rate];
  return numerics::newton_velocity_ulps * std::numeric_limits<double>::epsilon() * dashpot.damping * (std::abs(nodes.velocity[at(b.a)]) + std::abs(nodes.velocity[at(b.b)]));
}

void LooseDashpots::balance(const Nodes& nodes, std::vector<double>& rate_force, std::vector<double>& nodal) const {
  Eigen::VectorXd potential(static_cast<Eigen::Index>(nodes_.size()));
  std::vector<Conductance> conductances;
  bool balanced = true;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const std::size_t n = at(nodes_[k]);
    const double imbalance = nodal[n] - nodes.applied[n];
    const double rounding = numerics::sum_ulps * std::numeric_limits<double>::epsilon() * (nodes.magnitude[n] + std::abs(nodes.applied[n]));
    potential[static_cast<Eigen::Index>(k)] = -imbalance;
    conductances.push_back({static_cast<int>(k), -1, rounding * rounding});
    balanced = balanced && std::abs(imbalance) <= rounding;
  }
  if (balanced) return;
  for (const Dashpot& one : dashpots_) {
    const double rounding = roundoff_of(one, nodes);
    conductances.push_back({one.a, one.b, rounding * rounding});
  }
  if (!solve_conductances(conductances, potential)) return;
  const auto at_node = [&](int place) { return place < 0 ? 0 : potential[place]; };
  std::vector<double> change;
  for (const Dashpot& one : dashpots_) {
    const double rounding = roundoff_of(one, nodes);
    change.push_back(rounding * rounding * (at_node(one.a) - at_node(one.b)));
    if (!(std::abs(change.back()) <= rounding)) return;
  }
  for (std::size_t k = 0; k < dashpots_.size(); ++k) {
    const Branch& b = structure_->rates[dashpots_[k].rate];
    rate_force[dashpots_[k].rate] += change[k];
    nodal[at(b.a)] += change[k];
    nodal[at(b.b)] -= change[k];
  }
}

}  // namespace rheonet
