#include "core/dae/steady_friction.hpp"

#include <cmath>
#include <limits>

#include "core/base/index.hpp"

namespace rheonet {

SteadyFriction::SteadyFriction(const Network& network, Inputs& inputs, const State& sensed)
    : network_(network),
      inputs_(inputs),
      sensed_(sensed),
      follows_(network.sliders.size(), -1),
      broken_(network.sliders.size(), 0),
      losses_known_(std::none_of(network.trains.begin(), network.trains.end(), [](const Network::Train& train) { return train.loss.has_value(); })) {
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    for (const NodeId node : {network.sliders[k].branch.a, network.sliders[k].branch.b}) {
      if (follows_[k] < 0 && inputs.bounds_follow(k, node)) follows_[k] = node;
    }
  }
}

bool SteadyFriction::break_away(const std::vector<int>& direction) {
  bool any = false;
  for (std::size_t k = 0; k < direction.size(); ++k) {
    if (direction[k] == 0 || broken_[k]) continue;
    const Bounds& bounds = inputs_.box(k).at(direction[k]);
    if (!follows_speed(k) && bounds.breakaway.value == bounds.sliding.value) continue;
    broken_[k] = any = true;
  }
  return any;
}

/// Bounds of a slider at the velocity w. Other quantities that they depend on are taken at the present trial.
Bounds SteadyFriction::bounds_at(std::size_t slider, int side, double w) const {
  if (network_.sliders[slider].contact) return network_.sliders[slider].contact->at(side).at(side);
  if (!follows_speed(slider)) return inputs_.box(slider).at(side);
  const Branch& b = network_.sliders[slider].branch;
  const bool first = follows_[slider] == b.a;
  const double other = sensed_.velocity[at(first ? b.b : b.a)];
  return inputs_.supposed_box(slider, follows_[slider], first ? other + w : other - w).at(side);
}

SteadyFriction::Curve SteadyFriction::around(std::size_t slider, int side, double w) const {
  const Branch& b = network_.sliders[slider].branch;
  if (follows_speed(slider) && !along_curves_) w = sensed_.velocity[at(b.a)] - sensed_.velocity[at(b.b)];
  const Bounds bounds = bounds_at(slider, side, w);
  const Dual bound = broken_[slider] ? bounds.sliding : bounds.breakaway;
  // A curve that overflows resists any force.
  if (std::isnan(bounds.sliding.value)) return {side * w, std::numeric_limits<double>::infinity(), 0};
  const bool rises = follows_speed(slider) && side * w >= 0;
  return {side * w, bound.value, rises ? std::max(0.0, side * (follows_[slider] == b.a ? 1 : -1) * bound.derivative) : 0};
}

}  // namespace rheonet
