#include "core/solve/block_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

using Sort = Unknown::Sort;

BlockScales::BlockScales(const Network& network)
    : network_(network), gains_(network), output_seen_(network.blocks.blocks.size(), 0), force_seen_(network.forces.size(), 0), sensed_(network.nodes(), 0) {
  for (const Blocks::Sensor& sensor : network.blocks.sensors) {
    if (sensor.what == Blocks::Sensor::What::position) sensed_[at(sensor.index)] = 1;
  }
}

void BlockScales::follow(Dae& dae) {
  if (!network_.blocks.blocks.empty()) gains_.follow(dae.inputs().blocks());
}

void BlockScales::find(Dae& dae, const Dae::View& view, const Magnitudes& seen, const ByUnknown& foreseen, double largest_force, double local) {
  if (network_.blocks.blocks.empty()) return;
  for (std::size_t k = 0; k < most_.size(); ++k) most_[k].assign(seen.unknown[k].size(), std::numeric_limits<double>::infinity());
  BlockSignals& blocks = dae.inputs().blocks();
  for (std::size_t b = 0; b < output_seen_.size(); ++b) output_seen_[b] = std::max(output_seen_[b], std::abs(dae.inputs().blocks().out(static_cast<int>(b)).value));
  const double least_share = std::max(numerics::block_input_share, numerics::block_input_ulps * std::numeric_limits<double>::epsilon() / local);
  gains_.for_each([&](int block, BlockGains::Of of, int index, double gain, double together) {
    // Divided by `together` twice: the error of each quantity also contains the errors of the others.
    const double allowed = output_seen_[at(block)] / (together * together * gain);
    const bool state = of == BlockGains::Of::state;
    const auto sort = static_cast<std::size_t>(state ? Sort::block : of == BlockGains::Of::position ? Sort::position : Sort::velocity);
    // Nodes that sticking sliders join have one velocity, but a position each.
    const std::size_t k = at(state ? blocks.state_of(index) : of == BlockGains::Of::position ? index : dae.structure().rigid[at(index)]);
    if (k >= most_[sort].size()) return;
    const double least = least_share * seen.unknown[sort][k];
    // While a state has only begun to grow, the output behind it is as small as the state.
    if (allowed > 0) most_[sort][k] = std::min(most_[sort][k], std::max({allowed, least, state ? foreseen[sort][k] / (together * together) : 0.0}));
  });
  // Nothing restores a given motion: an error of its velocity moves its position until the run ends.
  const double length = network_.scene->stop - network_.scene->start;
  const std::vector<double>& places = seen.unknown[static_cast<std::size_t>(Sort::position)];
  for (const Network::Motion& motion : network_.motions) {
    const int state = motion.block >= 0 ? blocks.state_of(motion.block) : -1;
    const double place = state >= 0 && !places.empty() ? places[at(motion.node)] : 0;
    if (!(place > 0)) continue;
    const auto of_state = [&](auto& values) -> auto& { return values[static_cast<std::size_t>(Sort::block)][at(state)]; };
    of_state(most_) = std::min(of_state(most_), std::max({place / length, least_share * of_state(seen.unknown), of_state(foreseen)}));
  }
  if (!network_.blocks.sensors.empty()) find_behind_forces(dae, view, largest_force);
}

void BlockScales::find_behind_forces(Dae& dae, const Dae::View& view, double largest_force) {
  BlockSignals& blocks = dae.inputs().blocks();
  blocks.update_slopes(dae.inputs().history());
  if (!states_of_laws_) find_states_of_laws(dae);
  least_state_.assign(blocks.states(), 0);
  for (const auto& [block, state] : *states_of_laws_) {
    const double slope = std::abs(blocks.slopes().of_output(block, state));
    if (slope > 0) least_state_[state] = numerics::scale_floor * largest_force / slope;
  }
  std::vector<double>& positions = most_[static_cast<std::size_t>(Sort::position)];
  for (std::size_t f = 0; f < network_.forces.size(); ++f) {
    const int block = network_.forces[f].block;
    if (block < 0) continue;
    force_seen_[f] = std::max(force_seen_[f], std::abs(dae.inputs().force[f]));
    const double seen = std::max(force_seen_[f], numerics::scale_floor * largest_force);
    for (std::size_t s = 0; s < network_.blocks.sensors.size() && !positions.empty(); ++s) {
      const Blocks::Sensor& sensor = network_.blocks.sensors[s];
      if (sensor.what != Blocks::Sensor::What::position) continue;
      const double stiffness = std::abs(blocks.slopes().of_output(block, blocks.states() + s));
      const NodeId node = dae.structure().rigid[at(sensor.index)];
      const double force = std::max(seen, std::abs(view.velocity[at(node)]) * std::sqrt(stiffness * dae.structure().inertia[at(node)]));
      double& scale = positions[at(sensor.index)];
      if (stiffness > 0 && force > 0) scale = std::min(scale, force / stiffness);
    }
  }
}

void BlockScales::find_states_of_laws(Dae& dae) {
  const BlockSignals& blocks = dae.inputs().blocks();
  std::vector<char> elsewhere(blocks.states(), 0);  // acts on more than the force of a law
  const auto acts = [&](int block) {
    for (std::size_t s = 0; block >= 0 && s < elsewhere.size(); ++s) elsewhere[s] = elsewhere[s] || blocks.slopes().couples(block, s);
  };
  for (const Network::Motion& motion : network_.motions) acts(motion.block);
  for (const Network::Slider& slider : network_.sliders) {
    for (const Network::VaryingParameter& varying : slider.varying) acts(varying.block);
  }
  for (const Network::Force& force : network_.forces) acts(force.resists ? -1 : force.block);
  for (std::size_t k = 0; k < elsewhere.size(); ++k) {
    for (std::size_t s = 0; s < elsewhere.size(); ++s) elsewhere[s] = elsewhere[s] || (s != k && blocks.slopes().rate_couples(k, s));
  }
  states_of_laws_.emplace();
  for (const Network::Force& force : network_.forces) {
    for (std::size_t s = 0; force.resists && force.block >= 0 && s < elsewhere.size(); ++s) {
      if (!elsewhere[s] && blocks.slopes().couples(force.block, s)) states_of_laws_->emplace_back(force.block, s);
    }
  }
}

}  // namespace rheonet
