#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"

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

double way_to_contact(const Network& network, const Network::Slider& slider, double step, const State& state) {
  if (network.contact_of(slider) * step > 0) return 0;
  const double d = displacement(slider, state);
  return std::max(0.0, step > 0 ? slider.contact->highest - d : d - slider.contact->lowest);
}

}  // namespace rheonet
