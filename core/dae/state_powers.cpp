#include "core/dae/state_powers.hpp"

#include <algorithm>

#include "core/base/index.hpp"

namespace rheonet {

/// The velocity of the node that the force pushes, relative to the one that supports it [m/s].
double StatePowers::velocity_across(const Network::Force& force) const {
  return view_.velocity[at(force.a)] - (force.b >= 0 ? view_.velocity[at(force.b)] : 0);
}

double StatePowers::reaction(NodeId node) const {
  double force = view_.nodal[at(node)] - view_.applied[at(node)] + dae_.structure().own_mass[at(node)] * view_.acceleration[at(node)];
  for (std::size_t k = 0; k < network_.inerters.size(); ++k) {
    const Branch& b = network_.inerters[k].branch;
    if (b.a == node) force += inerter_force(k);
    if (b.b == node) force -= inerter_force(k);
  }
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    const Network::Train& train = network_.trains[k];
    for (std::size_t i = 0; i < train.node.size(); ++i) {
      if (train.node[i] == node) force += dae_.slip().train_forces()[k][i] * view_.train_force[k];
    }
  }
  return force;
}

double StatePowers::inerter_force(std::size_t k) const {
  const auto& [branch, inertance] = network_.inerters[k];
  return inertance * (view_.acceleration[at(branch.a)] - view_.acceleration[at(branch.b)]);
}

double StatePowers::inerter_energy(std::size_t k) const {
  const auto& [branch, inertance] = network_.inerters[k];
  const double w = view_.velocity[at(branch.a)] - view_.velocity[at(branch.b)];
  return inertance * w * w / 2;
}

double StatePowers::supplied() const {
  double power = 0;
  for (const Network::Motion& m : network_.motions) power += reaction(m.node) * view_.velocity[at(m.node)];
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& f = network_.forces[k];
    // A signal that changes the stiffness of a spring supplies energy too: the gain beyond the work done at its ends.
    if (f.lossless()) power += output_rate(f.energy);
    if (f.resists && !f.lossless()) continue;
    power += dae_.inputs().force[k] * velocity_across(f);
  }
  return power;
}

bool StatePowers::need_rates(const Dae& dae) {
  const std::vector<Laws<DeflectionBatch>>& all = dae.network().deflection_laws;
  return !dae.structure().groups.empty() ||
         std::any_of(all.begin(), all.end(),
                     [](const Laws<DeflectionBatch>& laws) { return !laws.batch->knows_heat(); });
}

double StatePowers::dissipated() const {
  double power = 0;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    if (laws.batch->knows_heat()) continue;
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      power += laws.batch->dissipated_power(i, view_.p[j], view_.dp[j], view_.flow[j]);
    }
  }
  for (std::size_t r = 0; r < view_.rate_force.size(); ++r) power += view_.rate_force[r] * view_.rate_velocity[r];
  for (std::size_t k = 0; k < view_.slider_force.size(); ++k) power += view_.slider_force[k] * view_.slider_velocity[k];
  // All power that such a force takes from the motion counts as heat here; `heat_of_laws` subtracts the part that it stores.
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& f = network_.forces[k];
    if (f.resists && !f.lossless()) power -= dae_.inputs().force[k] * velocity_across(f);
  }
  return power;
}

double StatePowers::heat_of_laws() const {
  double heat = 0;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; laws.batch->knows_heat() && i < laws.batch->size(); ++i) {
      heat += laws.batch->heat(i, view_.p[at(laws.first) + i]);
    }
  }
  for (const Network::Force& f : network_.forces) {
    if (f.energy >= 0 && !f.lossless()) heat -= dae_.inputs().blocks().out(f.energy).value;
  }
  return heat;
}

double StatePowers::stored() const {
  double energy = 0;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      energy += laws.batch->stored_energy(i, view_.p[at(laws.first) + i]);
    }
  }
  for (const Network::Force& f : network_.forces) {
    if (f.energy >= 0) energy += dae_.inputs().blocks().out(f.energy).value;
  }
  return energy + kinetic();
}

double StatePowers::kinetic() const {
  double energy = 0;
  for (std::size_t n = 0; n < view_.velocity.size(); ++n) {
    energy += dae_.structure().own_mass[n] * view_.velocity[n] * view_.velocity[n] / 2;
  }
  for (std::size_t k = 0; k < network_.inerters.size(); ++k) energy += inerter_energy(k);
  return energy;
}

double StatePowers::output_rate(int block) const {
  const BlockSignals& blocks = dae_.inputs().blocks();
  double sum = blocks.out(block).derivative;  // due to signals and prescribed motions, at held states and sensors
  for (std::size_t k = 0; k < blocks.states(); ++k) sum += blocks.slopes().of_output(block, k) * blocks.rate(k);
  for (std::size_t k = 0; k < blocks.sensed.size(); ++k) {
    const Blocks::Sensor& sensor = network_.blocks.sensors[k];
    if (sensor.what == Blocks::Sensor::What::force || sensor.motion >= 0) continue;
    sum += blocks.slopes().of_output(block, blocks.states() + k) *
           (sensor.what == Blocks::Sensor::What::position ? view_.velocity : view_.acceleration)[at(sensor.index)];
  }
  return sum;
}

/// Acceleration of a node whose motion is prescribed, by a function of time or by a block [m/s^2].

}  // namespace rheonet
