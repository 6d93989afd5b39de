#include "core/network/network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/netlist/characteristic.hpp"
#include "core/network/assumptions.hpp"
#include "core/network/effects.hpp"
#include "core/network/linear_law.hpp"
#include "core/network/resolved.hpp"
#include "core/network/rigid_links.hpp"
#include "core/network/transmission.hpp"

namespace rheonet {

namespace {

std::string describe(const std::string& what, const std::string& element, const std::string& rule) {
  return fmt::format("{} `{}`: {}", what, element, rule);
}

/// Branches of one role, sorted by component.
using ByComponent = std::map<std::string, std::vector<std::pair<Branch, Reduced>>>;

template <class Batch, class Make>
void batch_up(ByComponent& sorted, Role role, std::vector<Branch>& branches, std::vector<Laws<Batch>>& laws,
              std::vector<Network::Place>& places, Make make) {
  for (auto& [type, list] : sorted) {
    const Component* component = find_component(type);
    Values values;
    const int first = static_cast<int>(branches.size());
    for (auto& [branch, law] : list) {
      if (component->role == role) places[static_cast<std::size_t>(branch.element)] = {role, static_cast<int>(branches.size())};
      branches.push_back(branch);
      values.emplace_back(law.values, law.characteristic.get());
    }
    laws.push_back({component, first, make(*component, values)});
  }
}

/// Declared laws at the limits of their parameters. Throws SimulationError for elements that no network can have.
std::vector<Reduced> laws_of(const Scene& scene) {
  std::vector<Reduced> laws;
  laws.reserve(scene.elements.size());
  for (const SceneElement& element : scene.elements) {
    if (!element.at && element.a == element.b) {
      throw SimulationError(element.spot, describe("element", element.name,
                                                   fmt::format("both ends are at node `{}`, so that it can do nothing; "
                                                               "connect one end elsewhere or leave it out",
                                                               scene.nodes[static_cast<std::size_t>(element.a)].name)));
    }
    laws.push_back(law_of(scene, element));
  }
  return laws;
}

/// Numbers the nodes. Nodes inside pairs get none; free ends share the number of the node on which they hang.
void number_nodes(Network& network) {
  const Scene& scene = *network.scene;
  network.node_of.assign(scene.nodes.size(), 0);
  for (std::size_t k = 0; k < network.pairs.size(); ++k) {
    network.node_of[static_cast<std::size_t>(network.pairs[k].node)] = -1 - static_cast<int>(k);
  }
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (network.node_of[n] < 0 || network.free_ends.on[n] != static_cast<NodeId>(n)) continue;
    network.node_of[n] = static_cast<int>(network.scene_node.size());
    network.scene_node.push_back(static_cast<NodeId>(n));
  }
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (network.node_of[n] >= 0) network.node_of[n] = network.node_of[static_cast<std::size_t>(network.free_ends.on[n])];
  }
}

/// Makes one branch of all pairs between the same two nodes.
void tie_up_pairs(Network& network) {
  if (network.pairs.empty()) return;
  std::map<std::pair<NodeId, NodeId>, int> bundle_of;
  std::vector<std::vector<Iwan::Pair>> bundles;
  network.first_bundle = static_cast<int>(network.deflections.size());
  for (Pair& pair : network.pairs) {
    pair.spring_end = network.node_of[static_cast<std::size_t>(pair.spring_end)];
    pair.slider_end = network.node_of[static_cast<std::size_t>(pair.slider_end)];
    const auto [found, fresh] =
        bundle_of.try_emplace(std::minmax(pair.spring_end, pair.slider_end), static_cast<int>(bundles.size()));
    if (fresh) {
      bundles.emplace_back();
      network.deflections.push_back({pair.slider, pair.spring_end, pair.slider_end});
    }
    pair.bundle = found->second;
    std::vector<Iwan::Pair>& bundle = bundles[static_cast<std::size_t>(pair.bundle)];
    pair.index = bundle.size();
    pair.sign =
        network.deflections[static_cast<std::size_t>(network.first_bundle + pair.bundle)].a == pair.spring_end ? 1 : -1;
    bundle.push_back({pair.law.stiffness, pair.coulomb});
  }
  auto batch = std::make_unique<IwanBatch>();
  // A scene with rows at every event needs an event at every yield.
  const double kink_share = network.scene->output_events ? 0 : numerics::kink_event_share;
  for (std::vector<Iwan::Pair>& bundle : bundles) batch->add(Iwan(std::move(bundle), kink_share));
  network.bundles = batch.get();
  network.deflection_laws.push_back({nullptr, network.first_bundle, std::move(batch)});
}

}  // namespace

namespace {

template <class Batch>
Batch& batch_with(const std::vector<Laws<Batch>>& all, int branch, std::size_t& i) {
  for (const Laws<Batch>& laws : all) {
    if (branch >= laws.first + static_cast<int>(laws.batch->size())) continue;
    i = static_cast<std::size_t>(branch - laws.first);
    return *laws.batch;
  }
  throw std::out_of_range("no such branch");
}

}  // namespace

DeflectionBatch& Network::batch_of(int branch, std::size_t& i) const { return batch_with(deflection_laws, branch, i); }

RateBatch& Network::rate_of(int branch, std::size_t& i) const { return batch_with(rate_laws, branch, i); }

std::string at_time(const Scene& scene, double t) {
  // After a late start the same resolution of elapsed time takes more digits.
  const double elapsed = std::max(std::abs(t), numerics::time_resolution * (scene.stop - scene.start));
  const int digits = numerics::time_digits + static_cast<int>(std::ceil(std::max(0.0, std::log10(std::abs(scene.start) / elapsed))));
  return fmt::format("at t = {:.{}g} s", scene.start + t, std::min(digits, numerics::most_time_digits));
}

std::string with_unit(const Scene& scene, const SceneNode& of, double value, Quantity quantity) {
  return fmt::format("{:.6g} {}", value * own_unit(quantity, of.scale), unit_of(quantity, domain_of(scene, of)));
}

std::string with_unit(const Scene& scene, const SceneElement& of, double value, Quantity quantity) {
  return fmt::format("{:.6g} {}", value * own_unit(quantity, of.scale), unit_of(quantity, domain_of(scene, of)));
}

bool prescribes(const SceneElement& motion, Quantity quantity) {
  const auto declaration = static_cast<std::size_t>(motion.declaration);
  const auto parameter = static_cast<std::size_t>(motion.signal_parameters.at(0));
  return components()[declaration]->declaration.parameters[parameter].prescribes(quantity);
}

namespace {

/// Elements collected by component before they are made into batches.
struct Gathered { ByComponent deflections, rates; };

/// The parameters of a law for which the element has signals, unless a limit or an effect left out has replaced its law.
std::vector<int> varying_parameters(const SceneElement& element, const Reduced& law) {
  std::vector<int> result;
  const bool own = law.component == components()[static_cast<std::size_t>(element.declaration)] && same_values(law.values, element.values);
  if (own) result.assign(element.signal_parameters.begin(), element.signal_parameters.end());
  return result;
}

/// Gives a train that has losses the slider that stands for them.
void place_losses(Network& network, Network::Train& train, int index) {
  const SceneElement& element = network.scene->elements[static_cast<std::size_t>(train.element)];
  const Component& declared = *components()[static_cast<std::size_t>(element.declaration)];
  if (!declared.loss) return;
  std::vector<double> values = resolved_values(*network.scene, element);
  if (declared.loss(values).none()) return;
  Network::Slider slider{{train.element, train.node[0], train.node[2]}, {}, find_component(declared.with_row)};
  slider.train = index;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::isnan(values[k]) || !element.characteristic(k)) continue;
    double slope;
    values[k] = element.characteristic(k)->force(0, slope);
    slider.varying.push_back({static_cast<int>(k), -1, 1});
  }
  train.loss = declared.loss(values);
  train.friction = static_cast<int>(network.sliders.size());
  const auto bounds = [&](int side) { return Bounds{train.loss->lost(side, 0), train.loss->lost(side, 0)}; };
  slider.box = {bounds(1), bounds(-1)};
  slider.values = std::move(values);
  network.sliders.push_back(std::move(slider));
}

/// Stores an element in the list of its role.
void place_element(Network& network, int index, Reduced& law, const Branch& ends, Gathered& gathered) {
  const Scene& scene = *network.scene;
  const SceneElement& element = scene.elements[static_cast<std::size_t>(index)];
  Network::Place& place = network.places[static_cast<std::size_t>(index)];
  const Role role = law.component ? law.component->role : Role::nothing;
  const auto place_in = [&](const auto& list) { place = {role, static_cast<int>(list.size())}; };
  switch (role) {
    case Role::nothing:
      place = {Role::nothing, -1};
      if (left_out_of(scene, element).empty()) {
        network.notes.push_back(fmt::format("element `{}` carries no force: a parameter of it is 0", element.name));
      }
      break;
    case Role::deflection:
      if (auto force = law.component->beside ? law.component->beside(law.values) : std::nullopt) {
        network.beside[index] = static_cast<int>(network.forces.size());
        network.forces.push_back({.element = index, .a = ends.a, .b = ends.b, .signal = Signal(), .sign = -1, .resists = true, .beside = std::move(force)});
      }
      gathered.deflections[law.component->declaration.type].push_back({ends, std::move(law)});
      break;
    case Role::rate:
      gathered.rates[law.component->declaration.type].push_back({ends, std::move(law)});
      break;
    case Role::slip:
      place_in(network.sliders);
      network.sliders.push_back({ends, constant_box(*law.component, law.values), law.component});
      if (law.component->contact) {
        network.sliders.back().contact = law.component->contact(law.values);
        gathered.deflections[law.component->declaration.type].push_back({ends, std::move(law)});
        break;
      }
      // Their blocks are found later.
      for (const int parameter : varying_parameters(element, law)) {
        network.sliders.back().values = law.values;
        network.sliders.back().varying.push_back({parameter, -1, 1});
      }
      network.sliders.back().characteristic = law.characteristic.get();
      if (const auto over = over_velocity(*law.component, {law.values, law.characteristic.get()})) {
        network.sliders.back().values = law.values;
        network.sliders.back().varying.push_back({over->parameter, -1, 1});
      }
      break;
    case Role::mass:
      place_in(network.masses);
      network.masses.push_back({index, ends.a, law.values[0]});
      break;
    case Role::inerter:
      place_in(network.inerters);
      network.inerters.push_back({ends, law.values[0]});
      break;
    case Role::train: {
      const auto node = [&](NodeId n) { return network.node_of[static_cast<std::size_t>(n)]; };
      place_in(network.trains);
      network.trains.push_back({index, {ends.a, ends.b, node(element.support)}, element.row});
      place_losses(network, network.trains.back(), place.index);
      break;
    }
    case Role::motion:
      place_in(network.motions);
      network.motions.push_back({index, ends.a, element.signals.at(0).seen_from(scene.start), prescribes(element, Quantity::position),
                                 prescribes(element, Quantity::acceleration)});
      break;
    case Role::force:
      place_in(network.forces);
      if (const auto& varying = components()[static_cast<std::size_t>(element.declaration)]->varying) {
        network.forces.push_back({.element = index, .a = ends.a, .b = ends.b, .signal = Signal(), .sign = -1, .resists = true, .varying = varying(resolved_values(scene, element))});
        break;
      }
      network.forces.push_back({index, ends.a, element.at ? -1 : ends.b, element.signals.at(0).seen_from(scene.start)});
      if (law.component->declaration.resists) {
        network.forces.back().resists = true;
        network.forces.back().signal = network.forces.back().signal.times(-1);
      }
      break;
    case Role::block:
      place = {role, -1};
      break;
  }
}

/// Connects sliders that have a force only in contact to their gauges.
void find_gauges(Network& network) {
  for (int j = 0; j < static_cast<int>(network.deflections.size()); ++j) {
    if (!network.is_gauge(j)) continue;
    const int element = network.deflections[static_cast<std::size_t>(j)].element;
    network.sliders[static_cast<std::size_t>(network.places[static_cast<std::size_t>(element)].index)].gauge = j;
  }
}

/// Connects motions and forces to the blocks that feed them.
void feed_sources(Network& network) {
  for (const SceneFeed& feed : network.scene->feeds) {
    const auto [role, index, unused] = network.places[static_cast<std::size_t>(feed.element)];
    const SceneElement& element = network.scene->elements[static_cast<std::size_t>(feed.element)];
    const Declaration& declaration = components()[static_cast<std::size_t>(element.declaration)]->declaration;
    if (role == Role::force && declaration.parameters[static_cast<std::size_t>(feed.parameter)].quantity == Quantity::energy) {
      network.forces[static_cast<std::size_t>(index)].energy = feed.block;
      continue;
    }
    if (role != Role::motion && role != Role::force) continue;
    if (role == Role::force && network.forces[static_cast<std::size_t>(index)].varying) continue;
    const auto take = [&](auto& source) {
      source.block = feed.block;
      source.sign = declaration.resists ? -feed.sign : feed.sign;
    };
    role == Role::motion ? take(network.motions[static_cast<std::size_t>(index)]) : take(network.forces[static_cast<std::size_t>(index)]);
  }
}

/// The acceleration of a node that a block moves is not known beforehand: an inerter or a train there has no force to be computed.
void refuse_inerters_at_blocks(const Network& network) {
  for (const Network::Motion& motion : network.motions) {
    const std::vector<SceneFeed>& feeds = network.scene->feeds;
    const bool fed = std::any_of(feeds.begin(), feeds.end(), [&](const SceneFeed& feed) { return feed.element == motion.element; });
    for (const Network::Train& train : network.trains) {
      if (!fed || std::find(train.node.begin(), train.node.end(), motion.node) == train.node.end()) continue;
      const std::string& name = network.scene->elements[static_cast<std::size_t>(train.element)].name;
      throw SimulationError(network.spot_of(train.element),
                            fmt::format("transmission `{}` joins node `{}`, which a block moves: its acceleration, and with it the force of the "
                                        "transmission, is not known; put a stiff spring between",
                                        name, network.node_name(motion.node)));
    }
    for (const Network::Inerter& inerter : network.inerters) {
      if (!fed || (inerter.branch.a != motion.node && inerter.branch.b != motion.node)) continue;
      throw SimulationError(network.spot_of(inerter.branch.element),
                            fmt::format("inerter `{}` ends at node `{}`, which a block moves: its acceleration, and with it the force of the "
                                        "inerter, is not known; put a stiff spring between",
                                        network.name_of(inerter.branch), network.node_name(motion.node)));
    }
  }
}

/// Between masses and motions any friction has its force. At a node without mass the balance of forces gives its velocity: it must rise
/// with the velocity, and be part of that balance.
void refuse_falling_friction(const Network& network) {
  std::vector<char> firm(network.nodes(), 0);
  firm[ground] = 1;
  for (const Network::Mass& mass : network.masses) firm[static_cast<std::size_t>(mass.node)] = 1;
  for (const Network::Motion& motion : network.motions) firm[static_cast<std::size_t>(motion.node)] = 1;
  // The equation of a train gives the velocity of a node without mass (assign_trains refuses more of them).
  for (const Network::Train& train : network.trains) {
    for (const NodeId node : train.node) firm[static_cast<std::size_t>(node)] = 1;
  }
  const std::vector<NodeId> held = linked_to(network, firm);
  const auto refuse_massless = [&](const Branch& b, const char* how) {
    for (const NodeId node : {b.a, b.b}) {
      if (held[static_cast<std::size_t>(node)] >= 0) continue;
      throw SimulationError(network.spot_of(b.element),
                            fmt::format("the force of `{}` {} the velocity, and node `{}` has no mass: no balance of forces determines its "
                                        "velocity; give it a mass",
                                        network.name_of(b), how, network.node_name(node)));
    }
  };
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->falls(i)) refuse_massless(network.rates[static_cast<std::size_t>(laws.first) + i], "falls with");
    }
  }
  for (const Network::Slider& slider : network.sliders) {
    if (over_velocity(*slider.component, slider.law_values())) refuse_massless(slider.branch, slider.characteristic ? "depends, by its curve, on" : "falls with");
  }
  for (const Network::Force& force : network.forces) {
    if (force.varying) refuse_massless({force.element, force.a, force.b}, "depends, by a parameter that varies in time, on");
    if (force.beside) refuse_massless({force.element, force.a, force.b}, "depends, by its damping, on");
  }
}

}  // namespace

Network build_network(const Scene& scene) {
  Network network;
  network.scene = &scene;
  network.places.assign(scene.elements.size(), {Role::nothing, -1});
  std::vector<Reduced> laws = laws_of(scene);
  network.free_ends = find_free_ends(scene, laws);
  for (const int e : network.free_ends.elements) laws[static_cast<std::size_t>(e)] = {nullptr, {}};
  network.pairs = find_pairs(scene, laws);
  for (std::size_t k = 0; k < network.pairs.size(); ++k) {
    const Pair& pair = network.pairs[k];
    for (const int e : {pair.spring, pair.slider}) {
      network.places[static_cast<std::size_t>(e)] = {laws[static_cast<std::size_t>(e)].component->role,
                                                     static_cast<int>(k), true};
    }
  }
  number_nodes(network);
  tell_lost_times(network);
  tell_left_out(network);
  tell_meaningless(network, laws);
  for (std::string& note : tell_free_ends(scene, network.free_ends)) network.notes.push_back(std::move(note));
  std::vector<char> named(network.nodes(), 0);
  const auto node_of = [&](NodeId node) { return network.node_of[static_cast<std::size_t>(node)]; };
  const auto name_node = [&](NodeId node) {
    if (node < 0 || std::exchange(named[static_cast<std::size_t>(node)], 1) != 0) return;
    network.node_order.push_back(node);
  };
  name_node(ground);
  std::vector<char> hangs(scene.elements.size(), 0);
  for (const int e : network.free_ends.elements) hangs[static_cast<std::size_t>(e)] = 1;
  Gathered gathered;
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    const int index = static_cast<int>(e);
    const Branch ends{index, node_of(element.a), node_of(element.b)};
    name_node(ends.a);
    if (!element.at) name_node(ends.b);
    if (element.support != ground) name_node(node_of(element.support));
    if (!network.places[e].paired && !hangs[e]) place_element(network, index, laws[e], ends, gathered);
  }
  batch_up(gathered.deflections, Role::deflection, network.deflections, network.deflection_laws, network.places,
           [](const Component& c, const Values& v) { return c.deflection(v); });
  batch_up(gathered.rates, Role::rate, network.rates, network.rate_laws, network.places,
           [](const Component& c, const Values& v) { return c.rate(v); });
  find_gauges(network);
  tie_up_pairs(network);
  feed_sources(network);
  network.blocks = find_blocks(network);
  refuse_inerters_at_blocks(network);
  refuse_falling_friction(network);
  for (std::size_t n = 0; n < network.nodes(); ++n) name_node(static_cast<NodeId>(n));
  return network;
}

}  // namespace rheonet
