#include "core/dae/position_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/dashpot_steps.hpp"
#include "core/dae/torn_links.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

namespace {

[[noreturn]] void refuse_tearing_step(const EventNetwork& net, double t, NodeId first, NodeId node, double by) {
  const LinksBetween links = links_between(net.network, first, node);
  throw SimulationError(net.network.spot_of(links.first), fmt::format("{} a step in position tears {} from {} by {}, and {} join{} them; leave out {} or {}",
                                    at_time(*net.network.scene, t), moved_node(net, node, ""), moved_node(net, first, ""),
                                    with_unit(*net.network.scene, net.network.node(node), std::abs(by), Quantity::position), links.words,
                                    links.several ? "" : "s", links.several ? "a link" : "the link",
                                    first == ground ? "the motion" : "one of the motions"));
}

/// Nodes that rigid links join to a prescribed node step with it, whatever their mass: they count as prescribed.
Structure take_along(const EventNetwork& net, double t, std::vector<double>& dx) {
  Structure led = net.structure;
  DisjointSets linked = joined_by_links(net.network);
  std::vector<NodeId> leader(dx.size(), -1);
  for (std::size_t n = 0; n < dx.size(); ++n) {
    if (net.structure.kind[n] != Kind::known) continue;
    const NodeId node = static_cast<NodeId>(n);
    if (!std::isfinite(dx[n])) {
      throw SimulationError(net.network.spot_of_node(node), fmt::format("{} a step moves {} beyond the range of double precision; check its signal",
                                                                     at_time(*net.network.scene, t), moved_node(net, node, "")));
    }
    NodeId& first = leader[at(linked.find(node))];
    if (first < 0) first = node;
    if (!step_together(dx[at(first)], dx[n])) refuse_tearing_step(net, t, first, node, dx[n] - dx[at(first)]);
  }
  for (std::size_t n = 0; n < dx.size(); ++n) {
    const NodeId first = leader[at(linked.find(static_cast<NodeId>(n)))];
    if (first < 0 || net.structure.group[n] >= 0) continue;  // floating nodes move along anyway: see QuasistaticJumps
    dx[n] = dx[at(first)];
    led.kind[n] = Kind::known;
  }
  return led;
}

[[noreturn]] void report_hidden_shares(const EventNetwork& net, double t) {
  std::vector<std::string> motions, dashpots;
  std::optional<Spot> where;
  for (std::size_t m = 0; m < net.network.motions.size(); ++m) {
    if (net.inputs.steps()[m] == 0) continue;
    if (!where) where = net.network.spot_of(net.network.motions[m].element);
    motions.push_back(net.network.scene->elements[at(net.network.motions[m].element)].name);
  }
  for (const Branch& b : net.network.rates) {
    if (net.massless(b.a) || net.massless(b.b)) dashpots.push_back(net.network.name_of(b));
  }
  throw SimulationError(where.value(), fmt::format(
      "{} rounding hides how dashpots {} share the step in position of {}: their values lie too far apart; give the step a time to "
      "rise in",
      at_time(*net.network.scene, t), format_list(dashpots), format_list(motions)));
}

void refuse_stretched_inerters(const EventNetwork& net, double t, const std::vector<double>& dx) {
  for (const Network::Inerter& inerter : net.network.inerters) {
    const Branch& b = inerter.branch;
    if (step_together(dx[at(b.a)], dx[at(b.b)])) continue;
    throw SimulationError(net.network.spot_of(b.element),
                          fmt::format("{} a step in position stretches inerter `{}` by {} in no time, which takes a force beyond any bound; "
                                      "give the step a time to rise in",
                                      at_time(*net.network.scene, t), net.network.name_of(b),
                                      with_unit(*net.network.scene, net.network.element_of(b), dx[at(b.a)] - dx[at(b.b)], Quantity::position)));
  }
}

void refuse_turned_trains(const EventNetwork& net, double t, const std::vector<double>& dx) {
  for (const Network::Train& train : net.network.trains) {
    double sum = 0, size = 0;
    for (std::size_t i = 0; i < train.node.size(); ++i) {
      sum += train.factor[i] * dx[at(train.node[i])];
      size += std::abs(train.factor[i] * dx[at(train.node[i])]);
    }
    if (std::abs(sum) <= numerics::equal_given_values * size) continue;
    throw SimulationError(net.network.spot_of(train.element),
                          fmt::format("{} a step in position turns transmission `{}` in no time, which takes a force beyond any bound; give the step a time "
                                      "to rise in",
                                      at_time(*net.network.scene, t), net.network.scene->elements[at(train.element)].name));
  }
}

/// Steps of nodes that no spring lets go elsewhere go no further than to a contact.
void refuse_steps_through_contacts(const EventNetwork& net, double t, const std::vector<double>& dx, const State& state) {
  for (std::size_t k = 0; k < net.network.sliders.size(); ++k) {
    const Branch& b = net.network.sliders[k].branch;
    if (!net.network.sliders[k].contact || !net.keep_distance(b.a, b.b) || step_together(dx[at(b.a)], dx[at(b.b)])) continue;
    const double step = dx[at(b.a)] - dx[at(b.b)];
    const double beyond = std::abs(step) - way_to_contact(net.network, net.network.sliders[k], step, state);
    if (beyond <= numerics::equal_given_values * std::abs(step)) continue;
    throw SimulationError(net.network.spot_of(b.element),
                          fmt::format("{} a step in position moves the ends of `{}` by {} beyond its bound in no time, which takes a force "
                                      "beyond any bound; give the step a time to rise in",
                                      at_time(*net.network.scene, t), net.network.name_of(b),
                                      with_unit(*net.network.scene, net.network.element_of(b), beyond, Quantity::position)));
  }
}

void refuse_steps_backwards(const EventNetwork& net, double t, const std::vector<double>& dx) {
  for (std::size_t k = 0; k < net.network.sliders.size(); ++k) {
    const Branch& b = net.network.sliders[k].branch;
    if (net.network.sliders[k].contact) continue;
    const double by = dx[at(b.a)] - dx[at(b.b)];
    if (net.massless(b.a) || net.massless(b.b) || step_together(dx[at(b.a)], dx[at(b.b)]) || is_rigid_link(net.network.sliders[k])) continue;
    if (!std::isinf(net.inputs.box(k).at(by < 0 ? -1 : 1).sliding.value)) continue;
    throw SimulationError(net.network.spot_of(b.element),
                          fmt::format("{} a step in position turns `{}` backwards by {} in no time, which takes a force beyond any bound; give "
                                      "the step a time to rise in",
                                      at_time(*net.network.scene, t), net.network.name_of(b), with_unit(*net.network.scene, net.network.element_of(b), std::abs(by), Quantity::position)));
  }
}

}  // namespace

PositionSteps::Steps PositionSteps::at_event(double t, bool stepped, const State& state, std::vector<std::string>& notes) {
  const std::vector<double> none(net_.structure.kind.size(), 0);
  Steps steps{none, none};
  if (!stepped) return steps;
  for (std::size_t m = 0; m < net_.network.motions.size(); ++m) steps.dx[at(net_.network.motions[m].node)] = net_.inputs.steps()[m];
  if (std::all_of(steps.dx.begin(), steps.dx.end(), [](double step) { return step == 0; })) return steps;
  const Structure led = take_along(net_, t, steps.dx);
  if (!go_with_dashpots(net_.network, led, steps.dx)) report_hidden_shares(net_, t);
  steps.momentum = momentum_through_dashpots(net_.network, led, steps.dx, t);
  refuse_stretched_inerters(net_, t, steps.dx);
  refuse_turned_trains(net_, t, steps.dx);
  refuse_steps_through_contacts(net_, t, steps.dx, state);
  refuse_steps_backwards(net_, t, steps.dx);
  const auto tell = [&](int element, const std::string& what, double by, const char* whose) {
    char& told = told_[at(element)];
    if (std::exchange(told, 1)) return;
    notes.push_back(fmt::format("{} a step in position moves {} by {} in no time: {} force at such a step is an "
                                "impulse, which no row shows and the energy account leaves out",
                                at_time(*net_.network.scene, t), what, with_unit(*net_.network.scene, net_.network.scene->elements[at(element)], by, Quantity::position), whose));
  };
  for (const Laws<RateBatch>& laws : net_.network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = net_.network.rates[at(laws.first) + i];
      if (laws.batch->impulse(i) == 0 || step_together(steps.dx[at(b.a)], steps.dx[at(b.b)])) continue;
      tell(b.element, fmt::format("dashpot `{}`", net_.network.name_of(b)), steps.dx[at(b.a)] - steps.dx[at(b.b)], "its");
    }
  }
  for (const Network::Mass& mass : net_.network.masses) {
    const double by = steps.dx[at(mass.node)];
    if (by == 0 || led.kind[at(mass.node)] != Kind::known) continue;
    tell(mass.element, fmt::format("mass `{}`", net_.network.scene->elements[at(mass.element)].name), by, "the motion's");
  }
  return steps;
}

}  // namespace rheonet
