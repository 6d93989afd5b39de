#include "core/solve/global_error_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

GlobalErrorModel::GlobalErrorModel(const Network& network, const Structure& structure, double length)
    : network_(network), structure_(structure), length_(length) {
  mode_changes_ = !std::all_of(network.sliders.begin(), network.sliders.end(), is_rigid_link) || !network.blocks.sensors.empty();
  DisjointSets sets(structure.kind.size());
  const auto join = [&](NodeId a, NodeId b) {
    if (structure.kind[at(a)] != Kind::known && structure.kind[at(b)] != Kind::known) sets.join(a, b);
  };
  for (const Branch& b : structure.deflections) join(b.a, b.b);
  for (const Branch& b : structure.rates) join(b.a, b.b);
  for (const Branch& b : structure.sliders) join(b.a, b.b);
  for (std::size_t n = 0; n < structure.kind.size(); ++n) join(static_cast<NodeId>(n), structure.rigid[n]);
  // The nodes of a transmission share their energy: friction at one of them damps all.
  for (const Network::Train& train : network.trains) {
    for (const NodeId a : train.node) {
      for (const NodeId b : train.node) join(a, b);
    }
  }
  part_of_node_.assign(structure.kind.size(), -1);
  std::vector<int> number(structure.kind.size(), -1);
  movers_.reserve(network.masses.size());
  for (std::size_t n = 0; n < structure.kind.size(); ++n) {
    if (structure.kind[n] == Kind::known || !(structure.own_mass[n] > 0)) continue;
    int& part = number[at(sets.find(static_cast<NodeId>(n)))];
    if (part < 0) {
      part = static_cast<int>(parts_.size());
      parts_.emplace_back();
    }
    movers_.push_back({.node = static_cast<NodeId>(n), .part = part, .mass = structure.own_mass[n]});
  }
  for (std::size_t n = 0; n < part_of_node_.size(); ++n) {
    if (structure.kind[n] != Kind::known) part_of_node_[n] = number[at(sets.find(static_cast<NodeId>(n)))];
  }
  power_.assign(parts_.size(), 0);
}

long GlobalErrorModel::Swing::turn(double x) {
  const signed char now = x > 0 ? 1 : -1;
  const bool turned = side == -now;
  side = now;
  if (turned) {
    of_turn = largest;
    ++turns;
    return 1;
  }
  // The quantity has grown so much that its turns so far were among values to be ignored: those of the first steps from rest.
  return of_turn <= numerics::turn_magnitude * largest ? -std::exchange(turns, 0) : 0;
}

double GlobalErrorModel::Mover::steepness(double time) const {
  const auto turns = static_cast<double>(velocity.turns);
  const double of_sine = std::numbers::pi * turns / time * velocity.largest;
  return turning / turns / of_sine;
}

int GlobalErrorModel::part_of(const Branch& b) const { return std::max(part_of_node_[at(b.a)], part_of_node_[at(b.b)]); }

void GlobalErrorModel::follow(double t, const Dae::View& view, bool driven) {
  const double step = t - time_;
  time_ = t;
  ++steps_;
  for (Part& part : parts_) part.steepness = 1;
  for (Mover& m : movers_) {
    Part& part = parts_[at(m.part)];
    const double acceleration = view.acceleration[at(m.node)];
    const long turned = m.velocity.follow(view.velocity[at(m.node)]);
    part.turns += turned + m.acceleration.follow(acceleration);
    if (turned != 0) m.turning = turned > 0 ? m.turning + std::abs(acceleration) : 0;
    const bool remembers = static_cast<double>(m.velocity.turns) > part.forgotten;
    if (remembers && !driven) part.steepness = std::max(part.steepness, m.steepness(time_));
  }
  if (!mode_changes_) account(step, view);
}

/// Updates the energy stored in each part, and how often it has been dissipated.
void GlobalErrorModel::account(double step, const Dae::View& view) {
  std::fill(power_.begin(), power_.end(), 0.0);
  for (Part& part : parts_) part.stored = 0;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const int part = part_of(structure_.deflections[j]);
      if (part < 0) continue;
      parts_[at(part)].stored += laws.batch->stored_energy(i, view.p[j]);
      if (!laws.batch->knows_heat()) power_[at(part)] += laws.batch->dissipated_power(i, view.p[j], view.dp[j], view.flow[j]);
    }
  }
  for (std::size_t r = 0; r < structure_.rates.size(); ++r) {
    const int part = part_of(structure_.rates[r]);
    if (part >= 0) power_[at(part)] += view.rate_force[r] * view.rate_velocity[r];
  }
  for (const Mover& m : movers_) {
    const double v = view.velocity[at(m.node)];
    parts_[at(m.part)].stored += m.mass * v * v / 2;
  }
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Part& part = parts_[k];
    const double heat = step * (part.power + power_[k]) / 2;
    part.power = power_[k];
    part.energy = std::max(part.energy - heat, part.stored);
    if (part.energy > 0) part.forgotten += heat / part.energy;
  }
}

double GlobalErrorModel::remembered(const Part& part) const {
  return part.turns > 0 ? part.steepness / std::max(part.forgotten, time_ / length_) : 0;
}

double GlobalErrorModel::local_share() const {
  double share = 0;
  for (const Part& part : parts_) share = std::max(share, remembered(part));
  // Steps are assumed to go on at the same rate: `share` scales the count so far to the run, or to the time of forgetting.
  return 1 / (1 / numerics::step_tolerance + numerics::accumulated_error * share * static_cast<double>(steps_));
}

double GlobalErrorModel::dense_share() const {
  double turns = 0;
  for (const Part& part : parts_) turns = std::max(turns, remembered(part) * static_cast<double>(part.turns));
  return std::max(local_share(), 1 / (1 / numerics::kink_step_tolerance + numerics::kink_accumulated_error * numerics::steps_between_turns * turns));
}

}  // namespace rheonet
