// Force, velocity, power and energy of single elements.
#include <algorithm>

#include "core/base/index.hpp"
#include "core/dae/state_powers.hpp"
#include "core/result/output_sampler.hpp"
#include "core/result/pair_view.hpp"

namespace rheonet {

/// Force of an element beside that of its law (Component::beside).
double OutputSampler::force_beside(int element) const {
  const auto found = network_.beside.find(element);
  return found == network_.beside.end() ? 0 : -dae_->inputs().force[at(found->second)];
}

/// Force of the losses of a train at its first node.
double OutputSampler::loss_force(int train, const Dae::View& view) const {
  const int friction = network_.trains[at(train)].friction;
  return friction < 0 ? 0 : view.slider_force[at(friction)];
}

double OutputSampler::element_force(int element, const Dae::View& view) const {
  const Network& network = network_;
  const Network::Place& place = network.places[at(element)];
  if (place.paired) {
    const PairView pair(network, place.index, view);
    return (element == pair.pair.spring ? pair.pair.spring_sign : pair.pair.slider_sign) * pair.force();
  }
  switch (place.role) {
    case Role::deflection: {
      // Round-off of the displacement times a stiffness of 1e12 N/m can lift the force above its bound before the event is found.
      // At rest there is no such event, and a force above its bound is shown as it is.
      std::size_t i = 0;
      const DeflectionBatch& batch = network.batch_of(place.index, i);
      const double force = view.f[at(place.index)], bound = batch.steady(i).bound;
      return (batch.direction(i) == 0 ? force : std::clamp(force, -bound, bound)) + force_beside(element);
    }
    case Role::rate:
      return view.rate_force[at(place.index)];
    case Role::slip:
      return view.slider_force[at(place.index)];
    case Role::mass: {
      const Network::Mass& m = network.masses[at(place.index)];
      return m.mass * view.acceleration[at(m.node)];
    }
    case Role::inerter:
      return StatePowers(*dae_).inerter_force(at(place.index));
    case Role::train:
      return view.train_force[at(place.index)] + loss_force(place.index, view);
    case Role::motion:
      return StatePowers(*dae_).reaction(network.motions[at(place.index)].node);
    case Role::force:
      return (network.forces[at(place.index)].resists ? -1 : 1) * dae_->inputs().force[at(place.index)];
    case Role::block:
    case Role::nothing:
      break;
  }
  return 0;
}

double OutputSampler::element_velocity(int element, const Dae::View& view) const {
  const Network::Place& place = network_.places[at(element)];
  if (place.paired) {
    const PairView pair(network_, place.index, view);
    const bool spring = element == pair.pair.spring;
    if (spring == pair.slips()) return 0;
    return (spring ? pair.pair.spring_sign : pair.pair.slider_sign) * pair.pair.sign * view.flow[at(pair.branch)];
  }
  if (place.role == Role::deflection) return view.flow[at(place.index)];
  if (place.role == Role::rate) return view.rate_velocity[at(place.index)];
  if (place.role == Role::slip) return view.slider_velocity[at(place.index)];
  return velocity(scene_.elements[at(element)].a, view) - velocity(scene_.elements[at(element)].b, view);
}

/// Power that becomes heat.
double OutputSampler::dissipated_power(int element, const Dae::View& view) const {
  const Network::Place& place = network_.places[at(element)];
  if (!place.paired && place.role == Role::deflection) {
    std::size_t i = 0;
    const DeflectionBatch& batch = network_.batch_of(place.index, i);
    const std::size_t j = at(place.index);
    return batch.dissipated_power(i, view.p[j], view.dp[j], view.flow[j]) + force_beside(element) * view.flow[j];
  }
  if (place.role == Role::force && network_.forces[at(place.index)].resists) {
    if (network_.forces[at(place.index)].lossless()) return 0;
    const int energy = network_.forces[at(place.index)].energy;
    return element_force(element, view) * element_velocity(element, view) - (energy < 0 ? 0 : StatePowers(*dae_).output_rate(energy));
  }
  if (!place.paired && place.role == Role::train) {
    const int friction = network_.trains[at(place.index)].friction;
    return friction < 0 ? 0 : view.slider_force[at(friction)] * view.slider_velocity[at(friction)];
  }
  // The spring of a pair stores; rate laws and sliders store nothing.
  const bool dissipates = place.paired ? element != network_.pairs[at(place.index)].spring
                                       : place.role == Role::rate || place.role == Role::slip;
  return dissipates ? element_force(element, view) * element_velocity(element, view) : 0;
}

double OutputSampler::stored_energy(int element, const Dae::View& view) const {
  const Network::Place& place = network_.places[at(element)];
  if (place.paired) {
    const PairView pair(network_, place.index, view);
    return element == pair.pair.spring ? pair.force() * pair.force() / (2 * pair.pair.law.stiffness) : 0;
  }
  if (place.role == Role::deflection) {
    std::size_t i = 0;
    const DeflectionBatch& batch = network_.batch_of(place.index, i);
    return batch.stored_energy(i, view.p[at(place.index)]);
  }
  if (place.role == Role::force && network_.forces[at(place.index)].energy >= 0) return dae_->inputs().blocks().out(network_.forces[at(place.index)].energy).value;
  if (place.role == Role::inerter) return StatePowers(*dae_).inerter_energy(at(place.index));
  if (place.role != Role::mass) return 0;
  const Network::Mass& m = network_.masses[at(place.index)];
  return m.mass * view.velocity[at(m.node)] * view.velocity[at(m.node)] / 2;
}

}  // namespace rheonet
