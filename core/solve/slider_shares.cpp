#include "core/solve/slider_shares.hpp"

#include <algorithm>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

SliderShares::SliderShares(const Network& network) : network_(network), rested_(network.sliders.size(), 0), slid_(network.sliders.size(), 0) {}

void SliderShares::see(const Dae::View& view) {
  for (std::size_t k = 0; k < rested_.size(); ++k) {
    if (rested_[k]) continue;
    const double velocity = view.slider_velocity[k];
    const signed char now = velocity > 0 ? 1 : velocity < 0 ? -1 : 0;
    rested_[k] = now == 0 || now == -slid_[k];
    slid_[k] = now;
    any_rested_ = any_rested_ || rested_[k];
  }
}

void SliderShares::find(Dae& dae, const std::vector<Unknown>& unknowns, const SeparatedParts& parts, const Magnitudes& seen, const std::vector<double>& block_force) {
  using Sort = Unknown::Sort;
  share_.assign(unknowns.size(), 1);
  if (!any_rested_) return;
  const Structure& structure = dae.structure();
  std::vector<double> force(parts.nodes(), 0), share(parts.nodes(), 1);
  const auto meet = [&](const Branch& b, double f) {
    double& largest = force[at(parts.of(b))];
    largest = std::max(largest, f);
  };
  for (std::size_t j = 0; j < seen.force.size(); ++j) meet(structure.deflections[j], seen.force[j]);
  for (std::size_t r = 0; r < seen.dashpot.size(); ++r) meet(structure.rates[r], seen.dashpot[r]);
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& f = network_.forces[k];
    meet({f.element, f.a, f.b < 0 ? ground : f.b}, block_force[k]);
  }
  for (std::size_t k = 0; k < rested_.size(); ++k) {
    const double bound = dae.inputs().box(k).largest();
    const std::size_t part = at(parts.of(structure.sliders[k]));
    if (!rested_[k] || !(bound > 0) || numerics::slider_force_ratio * bound >= force[part]) continue;
    share[part] = std::min(share[part], std::max(numerics::least_slider_share, numerics::slider_force_ratio * bound / force[part]));
  }
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto [sort, k] = unknowns[i];
    if (sort == Sort::deflection) share_[i] = share[at(parts.of(structure.deflections[k]))];
    if (sort == Sort::force) share_[i] = share[at(parts.of(structure.rates[k]))];
    if (sort == Sort::velocity || sort == Sort::position) share_[i] = share[at(parts.of(static_cast<NodeId>(k)))];
  }
}

}  // namespace rheonet
