#include "core/network/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace rheonet {

namespace {

/// An element's law after all limits of its parameters have been taken.
struct Reduced {
  const Component* component;  ///< nullptr: no force at all
  std::vector<double> values;
};

Reduced take_limits(const Component* component, std::vector<double> values) {
  for (bool again = true; again;) {
    again = false;
    for (const Limit& limit : component->limits) {
      if (!limit.applies(values)) continue;
      if (limit.becomes.empty()) return {nullptr, {}};
      values = limit.values(values);
      component = find_component(limit.becomes);
      again = true;
      break;
    }
  }
  return {component, std::move(values)};
}

std::string describe(const std::string& what, const std::string& element, const std::string& rule) {
  return fmt::format("{} `{}`: {}", what, element, rule);
}

/// Branches of one role while they are sorted by component.
using ByComponent = std::map<std::string, std::vector<std::pair<Branch, std::vector<double>>>>;

template <class Batch, class Make>
void batch_up(ByComponent& sorted, Role role, std::vector<Branch>& branches, std::vector<Laws<Batch>>& laws,
              std::vector<Network::Place>& places, Make make) {
  for (auto& [type, list] : sorted) {
    const Component* component = find_component(type);
    Values values;
    const int first = static_cast<int>(branches.size());
    for (auto& [branch, v] : list) {
      places[static_cast<std::size_t>(branch.element)] = {role, static_cast<int>(branches.size())};
      branches.push_back(branch);
      values.emplace_back(v);
    }
    laws.push_back({component, first, make(*component, values)});
  }
}

}  // namespace

DeflectionBatch& Network::batch_of(int branch, std::size_t& i) const {
  for (const Laws<DeflectionBatch>& laws : deflection_laws) {
    if (branch >= laws.first + static_cast<int>(laws.batch->size())) continue;
    i = static_cast<std::size_t>(branch - laws.first);
    return *laws.batch;
  }
  throw std::out_of_range("no such branch");
}

std::string at_time(const Scene& scene, double t) {
  // A late start leaves fewer digits to what has passed since: more are shown.
  const double elapsed = std::max(std::abs(t), 1e-3 * (scene.stop - scene.start));
  const int digits = 9 + static_cast<int>(std::ceil(std::max(0.0, std::log10(std::abs(scene.start) / elapsed))));
  return fmt::format("at t = {:.{}g} s", scene.start + t, std::min(digits, 16));
}

std::string with_unit(const Scene& scene, double value, Quantity quantity) {
  return fmt::format("{:.6g} {}", value, unit_of(quantity, scene.domain));
}

Network build_network(const Scene& scene) {
  Network network;
  network.scene = &scene;
  network.places.assign(scene.elements.size(), {Role::nothing, -1});
  ByComponent deflections, rates;
  std::vector<char> named(scene.nodes.size(), 0);
  const auto name_node = [&](NodeId node) {
    if (!std::exchange(named[static_cast<std::size_t>(node)], 1)) network.node_order.push_back(node);
  };
  name_node(ground);

  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    const int index = static_cast<int>(e);
    name_node(element.a);
    if (!element.at) name_node(element.b);
    const Component* declared = components()[static_cast<std::size_t>(element.declaration)];
    if (!element.at && element.a == element.b) {
      throw SimulationError(element.spot, describe("element", element.name,
                                                   fmt::format("both ends are at node `{}`, so that it can do nothing; "
                                                               "connect one end elsewhere or leave it out",
                                                               network.node_name(element.a))));
    }
    Reduced law = take_limits(declared, element.values);
    const Role role = law.component ? law.component->role : Role::nothing;
    Network::Place& place = network.places[e];
    switch (role) {
      case Role::nothing:
        place = {Role::nothing, -1};
        network.notes.push_back(fmt::format("element `{}` carries no force: a parameter of it is 0", element.name));
        break;
      case Role::deflection:
        deflections[law.component->declaration.type].push_back({{index, element.a, element.b}, std::move(law.values)});
        break;
      case Role::rate:
        rates[law.component->declaration.type].push_back({{index, element.a, element.b}, std::move(law.values)});
        break;
      case Role::slip:
        place = {role, static_cast<int>(network.sliders.size())};
        network.sliders.push_back({{index, element.a, element.b}, law.component->slip(law.values)});
        break;
      case Role::mass:
        place = {role, static_cast<int>(network.masses.size())};
        network.masses.push_back({index, element.a, law.values[0]});
        break;
      case Role::motion: {
        place = {role, static_cast<int>(network.motions.size())};
        const bool position = element.signal_parameters.at(0) == 0;
        network.motions.push_back({index, element.a, element.signals.at(0).seen_from(scene.start), position});
        break;
      }
      case Role::force:
        place = {role, static_cast<int>(network.forces.size())};
        network.forces.push_back({index, element.a, element.at ? -1 : element.b, element.signals.at(0).seen_from(scene.start)});
        break;
    }
  }
  batch_up(deflections, Role::deflection, network.deflections, network.deflection_laws, network.places,
           [](const Component& c, const Values& v) { return c.deflection(v); });
  batch_up(rates, Role::rate, network.rates, network.rate_laws, network.places,
           [](const Component& c, const Values& v) { return c.rate(v); });
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) name_node(static_cast<NodeId>(n));
  return network;
}

}  // namespace rheonet
