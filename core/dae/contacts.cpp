#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/dashpot_steps.hpp"
#include "core/dae/event_transition.hpp"

namespace rheonet {

void open_contact(const Network& network, const Network::Slider& slider) {
  std::size_t i = 0;
  DeflectionBatch& gauge = network.batch_of(slider.gauge, i);
  if (gauge.contact(i).value_or(0) != 0) gauge.switch_memory(i, 0, 0, 0);
}

void count_from_contact(const Network& network, const Network::Slider& slider, State& state) {
  std::size_t i = 0;
  network.batch_of(slider.gauge, i).recentre(i, state.p[at(slider.gauge)]);
  state.p[at(slider.gauge)] = 0;
  state.offset[at(slider.gauge)] = slider.contact->bound(network.contact_of(slider));
}

void start_contacts(const Network& network, State& state) {
  for (const Network::Slider& slider : network.sliders) {
    if (!slider.contact) continue;
    const Branch& b = slider.branch;
    const double d = displacement(slider, state), bound = std::clamp(d, slider.contact->lowest, slider.contact->highest);
    const double size = std::abs(state.position[at(b.a)]) + std::abs(state.position[at(b.b)]) + std::abs(d) + std::abs(bound);
    for (const int side : {-1, 1}) {
      if (network.contact_of(slider) != 0 || !(std::abs(d - slider.contact->bound(side)) <= numerics::equal_given_values * size)) continue;
      std::size_t i = 0;
      network.batch_of(slider.gauge, i).start(i, slider.contact->bound(side));
    }
    if (network.contact_of(slider) != 0) {
      count_from_contact(network, slider, state);
    } else if (d != bound) {
      const auto with_unit = [&](double x) { return rheonet::with_unit(*network.scene, network.element_of(b), x, Quantity::position); };
      std::string movable;
      for (const NodeId node : {b.a, b.b}) {
        if (node != ground) movable += (movable.empty() ? "node `" : " or `") + network.node_name(node) + '`';
      }
      throw SimulationError(network.spot_of(b.element),
                            fmt::format("element `{}` cannot start with the displacement {}: it is rigid at its bound, {}; change the start position "
                                        "of {}, or the bound",
                                        network.name_of(b), with_unit(d), with_unit(bound), movable));
    }
  }
}

int EventTransition::contacts() const {
  return static_cast<int>(std::count_if(network_.sliders.begin(), network_.sliders.end(), [](const Network::Slider& s) { return s.contact.has_value(); }));
}

/// How far a slider can go in the direction of `step` before it is in contact [m].
double EventTransition::way_to_contact(std::size_t slider, double step, const State& state) const {
  const Network::Slider& s = network_.sliders[slider];
  if (network_.contact_of(s) * step > 0) return 0;
  const double d = displacement(s, state);
  return std::max(0.0, step > 0 ? s.contact->highest - d : d - s.contact->lowest);
}

/// The share of a jump of massless nodes that leads to the first contact.
double EventTransition::share_to_contact(const Jump& jump, const State& state) const {
  double share = 1;
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double step = moved(jump, b.a) - moved(jump, b.b);
    const bool goes = network_.sliders[k].contact && step != 0 && network_.contact_of(network_.sliders[k]) * step <= 0 && !inputs_.box(k).rigid();
    if (goes) share = std::min(share, way_to_contact(k, step, state) / std::abs(step));
  }
  return share;
}

/// Steps of nodes that no spring lets go elsewhere go no further than to a contact.
void EventTransition::refuse_steps_through_contacts(double t, const std::vector<double>& dx, const State& state) const {
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (!network_.sliders[k].contact || !carried(b.a, b.b) || step_together(dx[at(b.a)], dx[at(b.b)])) continue;
    const double step = dx[at(b.a)] - dx[at(b.b)];
    const double beyond = std::abs(step) - way_to_contact(k, step, state);
    if (beyond <= numerics::equal_given_values * std::abs(step)) continue;
    throw SimulationError(network_.spot_of(b.element),
                          fmt::format("{} a step in position moves the ends of `{}` by {} beyond its bound in no time, which takes a force "
                                      "beyond any bound; give the step a time to rise in",
                                      at_time(*network_.scene, t), network_.name_of(b),
                                      with_unit(*network_.scene, network_.element_of(b), beyond, Quantity::position)));
  }
}

std::vector<double> EventTransition::slider_velocities(const State& state) const {
  const auto velocity = [&](NodeId n) { return led_by_[at(n)] >= 0 ? given_velocity(led_by_[at(n)]) : state.velocity[at(n)]; };
  std::vector<double> w;
  for (const Network::Slider& slider : network_.sliders) w.push_back(velocity(slider.branch.a) - velocity(slider.branch.b));
  return w;
}

/// An impact, in two phases (S. D. Poisson 1838). First all contacts take the impulses that end the motions they forbid: a plastic
/// impact. Then each contact in `hit` gives back its coefficient of restitution times its impulse. So w = -e w_before at a
/// single contact, and at all that are hit at once with the same e (Newton's law). Contacts that only touch give nothing back,
/// and neither do those in `settles`. Returns the energy that turns into heat [J]: the work of the impulses at the contacts.
double EventTransition::rebound(double t, const std::vector<int>& hit, const std::vector<int>& settles, State& state) const {
  const std::vector<double> none(structure_.kind.size(), 0);
  std::vector<double> given(network_.sliders.size(), 0), momentum(none);
  double heat = 0;
  const auto phase = [&] {
    const std::vector<double> before = slider_velocities(state);
    const std::vector<double> impulse = share_impulses(t, none, momentum, state);
    const std::vector<double> after = slider_velocities(state);
    for (std::size_t k = 0; k < given.size(); ++k) heat += (impulse[k] + given[k]) * (before[k] + after[k]) / 2;
    return impulse;
  };
  const std::vector<double> taken = phase();
  bool any = false;
  for (const int k : hit) {
    const Network::Slider& slider = network_.sliders[at(k)];
    if (!slider.contact || contains(settles, k)) continue;
    given[at(k)] = slider.contact->restitution * taken[at(k)];
    momentum[at(slider.branch.a)] -= given[at(k)];
    momentum[at(slider.branch.b)] += given[at(k)];
    any = any || given[at(k)] != 0;
  }
  if (any) phase();
  return heat;
}

/// Contacts that the selected modes do not hold are over.
void EventTransition::open_contacts(const Modes& modes, State& state, Change& change) const {
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Network::Slider& slider = network_.sliders[k];
    if (!slider.contact || apart(k)) continue;
    count_from_contact(network_, slider, state);
    if (modes.slider[k] == Modes::stuck) continue;
    const int side = network_.contact_of(slider);
    open_contact(network_, slider);
    if (contains(hit_, static_cast<int>(k))) change.impacts.push_back({slider.branch.element, -side});
  }
}

}  // namespace rheonet
