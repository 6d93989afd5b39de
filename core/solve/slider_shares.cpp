#include <algorithm>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

void Tolerances::see_rest(std::size_t slider, double velocity) {
  if (rested_[slider]) return;
  const signed char now = velocity > 0 ? 1 : velocity < 0 ? -1 : 0;
  rested_[slider] = now == 0 || now == -slid_[slider];
  slid_[slider] = now;
  any_rested_ = any_rested_ || rested_[slider];
}

/// The force of a slider at rest is the sum of the forces around it. These may have been many times larger while it slipped,
/// and their errors shift the position at which it stops: tolerances around it are relative to its own bound.
void Tolerances::find_slider_shares() {
  slider_share_.assign(quantity_.size(), 1);
  if (!any_rested_) return;
  const Structure& structure = dae_->structure();
  std::vector<double> force(part_.size(), 0);
  const auto meet = [&](const Branch& b, double f) {
    double& largest = force[at(part_of(b))];
    largest = std::max(largest, f);
  };
  for (std::size_t j = 0; j < force_seen_.size(); ++j) meet(structure.deflections[j], force_seen_[j]);
  for (std::size_t r = 0; r < dashpot_seen_.size(); ++r) meet(structure.rates[r], dashpot_seen_[r]);
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& f = network_.forces[k];
    meet({f.element, f.a, f.b < 0 ? ground : f.b}, block_force_seen_[k]);
  }
  std::vector<double> share(part_.size(), 1);
  for (std::size_t k = 0; k < rested_.size(); ++k) {
    const double bound = dae_->inputs().box(k).largest();
    const std::size_t part = at(part_of(structure.sliders[k]));
    if (!rested_[k] || !(bound > 0) || numerics::slider_force_ratio * bound >= force[part]) continue;
    share[part] = std::min(share[part], std::max(numerics::least_slider_share, numerics::slider_force_ratio * bound / force[part]));
  }
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const Quantity& q = quantity_[i];
    if (q.sort == Sort::deflection) slider_share_[i] = share[at(part_of(structure.deflections[q.index]))];
    if (q.sort == Sort::force) slider_share_[i] = share[at(part_of(structure.rates[q.index]))];
    if (q.sort == Sort::velocity || q.sort == Sort::position) slider_share_[i] = share[at(part_[q.index])];
  }
}

}  // namespace rheonet
