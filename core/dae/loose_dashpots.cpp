// Forces of dashpots between nodes of almost equal velocity.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/dae/dae.hpp"
#include "core/nonsmooth/conductances.hpp"

namespace rheonet {

void Dae::find_loose_dashpots() {
  std::vector<int> place(structure_->kind.size(), -1);
  const auto massless = [&](NodeId node) { return structure_->kind[at(node)] == Kind::viscous; };
  const auto place_of = [&](NodeId node) {
    if (massless(node) && place[at(node)] < 0) {
      place[at(node)] = static_cast<int>(loose_nodes_.size());
      loose_nodes_.push_back(node);
    }
    return place[at(node)];
  };
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const Branch& b = structure_->rates[r];
      const double damping = laws.batch->impulse(i);
      if (if_[r] >= 0 || b.a == b.b || !(damping > 0) || !std::isfinite(damping) || !(massless(b.a) || massless(b.b))) continue;
      const int a = place_of(b.a), c = place_of(b.b);
      loose_.push_back({r, a, c, damping});
    }
  }
}

/// B (v_a - v_b) has the round-off of both velocities, unlike the other forces: a massless node does not balance. The
/// corrections of the forces that restore the balances, each as a share of its own round-off, are of least norm:
///
///     minimise sum of (df/s)^2,  s = B u (|v_a| + |v_b|),  subject to  sum of +-df = -imbalance  at each massless node
///
/// The multipliers of the balances are the potentials of a network of conductances s^2. The round-off of its balance grounds
/// each node. An imbalance that round-off does not explain stays as it is.
void Dae::balance_loose_dashpots() {
  constexpr double unit = std::numeric_limits<double>::epsilon();
  std::vector<double>& magnitude = work_;
  std::fill(magnitude.begin(), magnitude.end(), 0.0);
  const auto add = [&](const Branch& b, double f) {
    if (b.a == b.b) return;
    magnitude[at(b.a)] += std::abs(f);
    magnitude[at(b.b)] += std::abs(f);
  };
  for (std::size_t j = 0; j < ip_.size(); ++j) add(structure_->deflections[j], view_.f[j]);
  for (std::size_t r = 0; r < if_.size(); ++r) add(structure_->rates[r], if_[r] >= 0 ? rate_in_[r] : rate_out_[r]);
  for (std::size_t k = 0; k < slip_force_.size(); ++k) add(structure_->sliders[k], slip_force_[k]);
  Eigen::VectorXd potential(static_cast<Eigen::Index>(loose_nodes_.size()));
  std::vector<Conductance> conductances;
  bool balanced = true;
  for (std::size_t k = 0; k < loose_nodes_.size(); ++k) {
    const std::size_t n = at(loose_nodes_[k]);
    const double imbalance = view_.nodal[n] - view_.applied[n];
    const double rounding = numerics::sum_ulps * unit * (magnitude[n] + std::abs(view_.applied[n]));
    potential[static_cast<Eigen::Index>(k)] = -imbalance;
    conductances.push_back({static_cast<int>(k), -1, rounding * rounding});
    balanced = balanced && std::abs(imbalance) <= rounding;
  }
  if (balanced) return;
  const auto rounding_of = [&](const Loose& one) {
    const Branch& b = structure_->rates[one.rate];
    return numerics::newton_velocity_ulps * unit * one.damping * (std::abs(v_[at(b.a)]) + std::abs(v_[at(b.b)]));
  };
  for (const Loose& one : loose_) {
    const double rounding = rounding_of(one);
    conductances.push_back({one.a, one.b, rounding * rounding});
  }
  if (!solve_conductances(conductances, potential)) return;
  const auto at_node = [&](int place) { return place < 0 ? 0 : potential[place]; };
  std::vector<double> change;
  for (const Loose& one : loose_) {
    const double rounding = rounding_of(one);
    change.push_back(rounding * rounding * (at_node(one.a) - at_node(one.b)));
    if (!(std::abs(change.back()) <= rounding)) return;
  }
  for (std::size_t k = 0; k < loose_.size(); ++k) {
    const Branch& b = structure_->rates[loose_[k].rate];
    rate_out_[loose_[k].rate] += change[k];
    view_.nodal[at(b.a)] += change[k];
    view_.nodal[at(b.b)] -= change[k];
  }
}

}  // namespace rheonet
