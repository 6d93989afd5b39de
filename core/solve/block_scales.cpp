#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Scales from blocks. A gain turns a small error of its input into a large error of its output: the quantities behind a
/// recorded output share its allowed error equally. A position behind a force may be off by the allowed error of the force
/// over its slope: a stop in the way of a far-travelling mass deflects little. Contact at speed v causes a force v sqrt(k m).
/// A state that acts by the force of its law alone need not be resolved finer than the smallest forces are.
void Tolerances::find_block_scales(double largest_force, const Dae::View& view) {
  if (network_.blocks.blocks.empty()) return;
  for (std::size_t k = 0; k < sorts; ++k) block_scale_[k].assign(seen_[k].size(), std::numeric_limits<double>::infinity());
  BlockSignals& blocks = dae_->inputs().blocks();
  for (std::size_t b = 0; b < block_output_seen_.size(); ++b) {
    block_output_seen_[b] = std::max(block_output_seen_[b], std::abs(dae_->output(static_cast<int>(b))));
  }
  block_gains_.for_each([&](int block, BlockGains::Of of, int index, double gain, double together) {
    // Divided by `together` twice: the error of each quantity also contains the errors of the others.
    const double allowed = block_output_seen_[at(block)] / (together * together * gain);
    const bool state = of == BlockGains::Of::state;
    const auto sort = static_cast<std::size_t>(state ? Sort::block : of == BlockGains::Of::position ? Sort::position : Sort::velocity);
    // Nodes that sticking sliders join have one velocity, but a position each.
    const std::size_t k = at(state ? blocks.state_of(index) : of == BlockGains::Of::position ? index : dae_->structure().rigid[at(index)]);
    if (k >= block_scale_[sort].size()) return;
    const double least = std::max(numerics::block_input_share, numerics::block_input_ulps * std::numeric_limits<double>::epsilon() / local()) * seen_[sort][k];
    if (allowed > 0) block_scale_[sort][k] = std::min(block_scale_[sort][k], std::max(allowed, least));
  });
  if (network_.blocks.sensors.empty()) return;
  blocks.update_slopes(dae_->inputs().history());
  if (!states_of_laws_) find_states_of_laws();
  least_state_.assign(blocks.states(), 0);
  for (const auto& [block, state] : *states_of_laws_) {
    const double slope = std::abs(blocks.slope(block, state));
    if (slope > 0) least_state_[state] = numerics::scale_floor * largest_force / slope;
  }
  for (std::size_t f = 0; f < network_.forces.size(); ++f) {
    const int block = network_.forces[f].block;
    if (block < 0) continue;
    block_force_seen_[f] = std::max(block_force_seen_[f], std::abs(dae_->inputs().force[f]));
    const double seen = std::max(block_force_seen_[f], numerics::scale_floor * largest_force);
    for (std::size_t s = 0; s < network_.blocks.sensors.size(); ++s) {
      const Blocks::Sensor& sensor = network_.blocks.sensors[s];
      if (sensor.what != Blocks::Sensor::What::position) continue;
      const double stiffness = std::abs(blocks.slope(block, blocks.states() + s));
      const NodeId node = dae_->structure().rigid[at(sensor.index)];
      const double force = std::max(seen, std::abs(view.velocity[at(node)]) * std::sqrt(stiffness * dae_->structure().inertia[at(node)]));
      if (block_scale_[static_cast<std::size_t>(Sort::position)].empty()) continue;
      double& scale = block_scale_[static_cast<std::size_t>(Sort::position)][at(sensor.index)];
      if (stiffness > 0 && force > 0) scale = std::min(scale, force / stiffness);
    }
  }
}

void Tolerances::find_states_of_laws() {
  const BlockSignals& blocks = dae_->inputs().blocks();
  std::vector<char> elsewhere(blocks.states(), 0);  // acts on more than the force of a law
  const auto acts = [&](int block) {
    for (std::size_t s = 0; block >= 0 && s < elsewhere.size(); ++s) elsewhere[s] = elsewhere[s] || blocks.couples(block, s);
  };
  for (const Network::Motion& motion : network_.motions) acts(motion.block);
  for (const Network::Slider& slider : network_.sliders) {
    for (const Network::VaryingParameter& varying : slider.varying) acts(varying.block);
  }
  for (const Network::Force& force : network_.forces) acts(force.resists ? -1 : force.block);
  for (std::size_t k = 0; k < elsewhere.size(); ++k) {
    for (std::size_t s = 0; s < elsewhere.size(); ++s) elsewhere[s] = elsewhere[s] || (s != k && blocks.rate_couples(k, s));
  }
  states_of_laws_.emplace();
  for (const Network::Force& force : network_.forces) {
    for (std::size_t s = 0; force.resists && force.block >= 0 && s < elsewhere.size(); ++s) {
      if (!elsewhere[s] && blocks.couples(force.block, s)) states_of_laws_->emplace_back(force.block, s);
    }
  }
}

}  // namespace rheonet
