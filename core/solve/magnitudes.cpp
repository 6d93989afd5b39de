#include "core/solve/magnitudes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

void raise(double& largest, double value) { largest = std::max(largest, std::abs(value)); }

}  // namespace

Magnitudes::Magnitudes(const Network& network) : network_(network) {
  const std::size_t nodes = network.nodes(), deflections = network.deflections.size();
  unknown = {std::vector<double>(nodes, 0), std::vector<double>(deflections, 0), std::vector<double>(network.rates.size(), 0), std::vector<double>{},
              std::vector<double>(network.blocks.blocks.size(), 0)};
  force.assign(deflections, 0);
  hop_ = flow = force;
  slide.assign(network.sliders.size(), 0);
  held = slide;
  dashpot.assign(network.rates.size(), 0);
  relative.assign(nodes, 0);
  least_slide.assign(nodes, std::numeric_limits<double>::infinity());
}

void Magnitudes::attach(const Dae& dae) {
  dae_ = &dae;
  // Only here, because most networks have no position among their unknowns in any mode.
  if (!dae.positions().integrated.empty()) {
    for (std::vector<double>* seen : {&unknown[static_cast<std::size_t>(Unknown::Sort::position)], &gap, &place, &way}) seen->resize(network_.nodes(), 0);
  }
  std::vector<char> positioned(dae.structure().of_time.begin(), dae.structure().of_time.end());
  for (const NodeId node : dae.positions().order) positioned[at(node)] = 1;
  gaps_.clear();
  has_gap.assign(positioned.size(), 0);
  const auto add = [&](const Branch& b) {
    if (!positioned[at(b.a)] || !positioned[at(b.b)]) return;
    for (const NodeId node : {b.a, b.b}) {
      if (dae.indices().position[at(node)] < 0) continue;
      gaps_.push_back({node, b});
      has_gap[at(node)] = 1;
    }
  };
  for (const Branch& b : network_.rates) add(b);
  for (const Network::Slider& s : network_.sliders) add(s.branch);
}

void Magnitudes::meet(const Branch& b, double w) {
  for (const NodeId node : {b.a, b.b}) raise(relative[at(node)], w);
}

void Magnitudes::see(const std::vector<Unknown>& unknowns, const std::vector<double>& y, const Dae::View& view) {
  for (std::size_t i = 0; i < y.size(); ++i) raise(of(unknown, unknowns[i]), y[i]);
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < force.size(); ++j) {
    raise(force[j], view.f[j]);
    raise(flow[j], view.flow[j]);
    meet(structure.deflections[j], view.flow[j]);
  }
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    raise(dashpot[r], view.rate_force[r]);
    meet(structure.rates[r], view.rate_velocity[r]);
  }
  see_sliders(view);
  see_positions(view);
  for (const Network::Motion& m : network_.motions) raise(motion, view.velocity[at(m.node)]);
  for (double f : view.applied) raise(applied, f);
}

void Magnitudes::see_sliders(const Dae::View& view) {
  const Structure& structure = dae_->structure();
  std::fill(least_slide.begin(), least_slide.end(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < slide.size(); ++k) {
    raise(slide[k], view.slider_velocity[k]);
    raise(held[k], view.slider_force[k]);
    // The bounds of losses have the round-off of the force of their train.
    if (const int train = network_.sliders[k].train; train >= 0) raise(held[k], view.train_force[at(train)]);
    meet(structure.sliders[k], view.slider_velocity[k]);
    if (!(slide[k] > 0)) continue;
    for (const NodeId node : {structure.sliders[k].a, structure.sliders[k].b}) least_slide[at(node)] = std::min(least_slide[at(node)], slide[k]);
  }
}

void Magnitudes::see_positions(const Dae::View& view) {
  for (const Gap& g : gaps_) raise(gap[at(g.node)], view.position[at(g.branch.a)] - view.position[at(g.branch.b)]);
  for (const NodeId node : dae_->positions().integrated) {
    raise(place[at(node)], view.position[at(node)]);
    raise(way[at(node)], view.position[at(node)]);
    raise(way[at(node)], view.position[at(dae_->positions().of[at(node)].parent)]);
  }
}

void Magnitudes::see_hops(const Dae::View& view, bool restarts) {
  for (const Network::Slider& slider : network_.sliders) {
    if (!slider.contact || slider.contact->restitution == 0) continue;
    const std::size_t j = at(slider.gauge);
    const bool begins = restarts && view.p[j] == 0;  // at a bound
    hop_[j] = std::max(begins ? 0 : hop_[j], std::abs(view.flow[j]));
  }
}

double Magnitudes::largest_relative_velocity() const { return *std::max_element(relative.begin(), relative.end()); }  // ground is always there

/// Each hop is resolved relative to its own height, which goes with the square of its velocity: so an error shifts the next contact, and
/// all that follow, by the same share of their times, however small the hop is.
double Magnitudes::hop_share(std::size_t branch) const {
  const double share = hop_[branch] / flow[branch];
  return numerics::hop_resolution * share * share;
}

}  // namespace rheonet
