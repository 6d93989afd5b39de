#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/event_transition.hpp"
#include "core/network/overload_report.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

double EventTransition::kinetic_energy(const State& state) const {
  double sum = 0;
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    if (structure_.kind[n] == Kind::massive) sum += structure_.mass[n] * state.velocity[n] * state.velocity[n] / 2;
  }
  for (const auto& [branch, inertance] : network_.inerters) {
    const double w = state.velocity[at(branch.a)] - state.velocity[at(branch.b)];
    sum += inertance * w * w / 2;
  }
  return sum;
}

std::vector<std::string> EventTransition::names_of(const std::vector<int>& sliders) const {
  std::vector<std::string> names;
  for (const int k : sliders) names.push_back(network_.name_of(network_.sliders[at(k)].branch));
  return names;
}

/// Gives masses the momentum of dashpots at steps in position [N s], and passes on the jumps of prescribed velocities through
/// inerters. Ends motions that a law forbids (a freewheel turned backwards by a step, or at the start; a rigid stop that is hit): an impact.
/// Returns the energy that this turns into heat [J].
double EventTransition::collide(double t, const std::vector<double>& momentum, const std::vector<int>& settles, State& state, Change& change) {
  std::vector<double> jump(structure_.kind.size(), 0);  // of the velocity of each prescribed node
  // At the start the state does not have these velocities yet: nothing jumps.
  for (std::size_t n = 0; started_ && n < jump.size(); ++n) {
    if (led_by_[n] >= 0) jump[n] = given_velocity(led_by_[n]) - state.velocity[n];
  }
  const double turned = started_ ? 0 : turn_trains(t, state, change.notes);
  started_ = true;
  const bool pushed = std::any_of(momentum.begin(), momentum.end(), [](double p) { return p != 0; });
  const auto jolted = [&](const Network::Inerter& i) { return jump[at(i.branch.a)] != 0 || jump[at(i.branch.b)] != 0; };
  const auto jerked = [&](const Network::Train& train) {
    return std::any_of(train.node.begin(), train.node.end(), [&](NodeId node) { return jump[at(node)] != 0; });
  };
  const bool coupled = !network_.inerters.empty() || !network_.trains.empty();
  if (coupled && (pushed || std::any_of(network_.inerters.begin(), network_.inerters.end(), jolted) ||
                  std::any_of(network_.trains.begin(), network_.trains.end(), jerked))) {
    share_impulses(t, jump, momentum, state);
  } else {
    for (std::size_t n = 0; pushed && n < momentum.size(); ++n) {
      if (momentum[n] != 0) state.velocity[n] += momentum[n] / structure_.mass[n];
    }
  }
  std::vector<int> backwards = moving_backwards(state);
  hit_.clear();
  largest_kinetic_ = std::max(largest_kinetic_, kinetic_energy(state));
  if (backwards.empty()) return turned;
  const double lost = std::max(0.0, rebound(t, backwards, settles, state));
  const auto in_contact = [&](int k) { return network_.sliders[at(k)].contact.has_value(); };
  std::copy_if(backwards.begin(), backwards.end(), std::back_inserter(hit_), in_contact);
  std::erase_if(backwards, in_contact);
  // Thrown back, they are apart, however short the hop is: mode selection looks further ahead.
  const std::vector<double> w = slider_velocities(state);
  for (const int k : hit_) {
    const Network::Slider& slider = network_.sliders[at(k)];
    const int side = network_.contact_of(slider);
    if (slider.contact->restitution == 0 || contains(settles, k) || !(side * w[at(k)] < 0)) continue;
    count_from_contact(network_, slider, state);
    open_contact(network_, slider);
    change.impacts.push_back({slider.branch.element, -side});
  }
  // A freewheel that ceases to run ahead has the round-off of its event as its velocity: no impact.
  const bool impact = lost > numerics::equal_energies * largest_kinetic_;
  if (t == 0 && impact && !hit_.empty()) {
    change.notes.push_back(fmt::format("{} {} start with an impact, which turns {:.6g} J into heat, before the energy account begins",
                                       at_time(*network_.scene, t), "the ends of " + format_list(names_of(hit_)), lost));
  }
  if (backwards.empty() || (!impact && t > 0)) return turned + lost;
  const std::vector<std::string> names = names_of(backwards);
  change.notes.push_back(fmt::format("{} {} would move backwards: {} ends go on together from there{}", at_time(*network_.scene, t), format_list(names),
                              names.size() > 1 ? "their" : "its",
                              impact ? fmt::format(", which turns {:.6g} J into heat{}", lost, t > 0 ? "" : ", before the energy account begins") : ""));
  return turned + lost;
}

std::vector<double> EventTransition::slips_of_trains(const std::vector<double>& velocity) const {
  std::vector<double> result;
  for (const Network::Train& train : network_.trains) {
    double sum = 0;
    for (std::size_t i = 0; i < train.node.size(); ++i) sum += train.factor[i] * velocity[at(train.node[i])];
    result.push_back(sum);
  }
  return result;
}

/// At the start, nodes that trains join need not have velocities that fit. They go on with common momentum, and the energy that this
/// takes is heat [J].
double EventTransition::turn_trains(double t, State& state, std::vector<std::string>& notes) {
  if (network_.trains.empty()) return 0;
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    if (structure_.kind[n] == Kind::known) state.velocity[n] = given_velocity(static_cast<NodeId>(n));
  }
  const std::vector<double> slips = slips_of_trains(state.velocity);
  if (std::all_of(slips.begin(), slips.end(), [](double slip) { return slip == 0; })) return 0;
  const double before = kinetic_energy(state);
  const std::vector<double> none(structure_.kind.size(), 0);
  share_impulses(t, none, none, state);
  const double lost = std::max(0.0, before - kinetic_energy(state));
  if (lost <= numerics::equal_energies * before) return 0;
  std::vector<std::string> names;
  for (const Network::Train& train : network_.trains) names.push_back(network_.scene->elements[at(train.element)].name);
  notes.push_back(fmt::format("{} transmission{} {} join{} masses that start with velocities that do not fit: they go on together, and lose {:.6g} J at "
                              "once, before the energy account begins",
                              at_time(*network_.scene, t), names.size() > 1 ? "s" : "", format_list(names), names.size() > 1 ? "" : "s", lost));
  return lost;
}

/// A velocity that an impulse has reduced to this share has stopped: it is round-off.
constexpr double stopped = numerics::sum_ulps * std::numeric_limits<double>::epsilon();

/// Changes the velocities of masses by impulses,
///     minimise 1/2 (v - v0)' M (v - v0) - momentum' v     with     w in the permitted direction, at every law without a bound.
/// Prescribed velocities change by `jump`. Friction, springs and dashpots take no impulse, but the sliders that stick in `held` do.
std::vector<double> EventTransition::share_impulses(double t, const std::vector<double>& jump, const std::vector<double>& momentum, State& state,
                                                    const Modes* held) const {
  ConvexNetwork problem(static_cast<int>(structure_.kind.size()));
  std::vector<char> reached(structure_.kind.size(), 0);  // by some impulse
  const auto add = [&](const Branch& b, const ConvexNetwork::Law& law) {
    reached[at(b.a)] = reached[at(b.b)] = 1;
    return problem.add(slot(b.a), slot(b.b), law);
  };
  for (const auto& [branch, inertance] : network_.inerters) add(branch, {.backward = inertance, .forward = inertance, .of_change = true});
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const auto impulse = [](const Bounds& bounds) { return std::isinf(bounds.sliding.value) ? bounds.sliding.value : 0; };
  std::vector<int> branch(network_.sliders.size(), -1);
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    ConvexNetwork::Law law{.low = -impulse(inputs_.box(k).backward), .high = impulse(inputs_.box(k).forward)};
    if (held && held->slider[k] == Modes::stuck) law = {.low = -unlimited, .high = unlimited};
    if (law.low < law.high) branch[k] = add(network_.sliders[k].branch, law);
  }
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    const auto node = static_cast<NodeId>(n);
    if (structure_.kind[n] == Kind::known) {
      problem.start(slot(node), given_velocity(node) - jump[n]);
      problem.fix(slot(node), jump[n]);
      continue;
    }
    problem.start(slot(node), state.velocity[n]);
    problem.load(slot(node), momentum[n]);
    if (structure_.kind[n] == Kind::massive) {
      problem.set_inertia(slot(node), structure_.mass[n]);
    } else if (!reached[n]) {
      problem.fix(slot(node), 0);
    }
  }
  std::vector<double> before = state.velocity;
  for (std::size_t n = 0; n < before.size(); ++n) {
    if (structure_.kind[n] == Kind::known) before[n] = given_velocity(static_cast<NodeId>(n)) - jump[n];
  }
  std::vector<double> slips = slips_of_trains(before);
  for (double& slip : slips) slip = -slip;
  add_trains(problem, slips);
  if (problem.solve() != ConvexNetwork::Outcome::solved) report_undecided(network_, at_time(*network_.scene, t));
  std::vector<char> of_train(structure_.kind.size(), 0);  // their velocities follow from those of masses
  for (const Network::Train& train : network_.trains) {
    for (const NodeId node : train.node) of_train[at(node)] = structure_.kind[at(node)] != Kind::known;
  }
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    if (structure_.kind[n] != Kind::massive && !of_train[n]) continue;
    const double was = state.velocity[n], is = problem.value(slot(static_cast<NodeId>(n)));
    state.velocity[n] = std::abs(is) <= stopped * std::abs(was) ? 0 : is;
  }
  std::vector<double> impulses(branch.size(), 0);
  for (std::size_t k = 0; k < branch.size(); ++k) {
    if (branch[k] >= 0) impulses[k] = problem.force(branch[k]);
  }
  return impulses;
}

/// Sliders between masses or prescribed nodes that move in a direction in which they have no bound.
std::vector<int> EventTransition::moving_backwards(const State& state) const {
  std::vector<int> result;
  const auto velocity = [&](NodeId n) { return led_by_[at(n)] >= 0 ? given_velocity(led_by_[at(n)]) : state.velocity[at(n)]; };
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const auto& [element, a, b] = network_.sliders[k].branch;
    // An impact goes on through nodes without mass that are in contact with others.
    const bool firm = (firm_[at(a)] && firm_[at(b)]) || network_.sliders[k].contact;
    if (prescribed(network_.sliders[k].branch) || !firm || is_rigid_link(network_.sliders[k])) continue;
    const double va = velocity(a), vb = velocity(b);
    const bool never = std::isinf(inputs_.box(k).at(va < vb ? -1 : 1).sliding.value);
    if (never && std::abs(va - vb) > numerics::equal_energies * (std::abs(va) + std::abs(vb))) result.push_back(static_cast<int>(k));
  }
  return result;
}

/// Masses that sliders bring to rest against each other go on with their common momentum: what remains of their relative
/// velocity is the round-off of the event. Rigid links do so at once, and the energy that this takes is heat.
double EventTransition::halt(double t, const std::vector<int>& events, const Modes& modes, State& state,
                     std::vector<std::string>& notes) const {
  refuse_torn_links(t);
  // Rigid links first, alone: friction between other nodes takes no impulse.
  std::vector<int> links;
  Modes held{std::vector<signed char>(modes.slider.size(), Modes::forward), modes.b_drives};
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    if (!is_rigid_link(network_.sliders[k])) continue;
    links.push_back(static_cast<int>(k));
    held.slider[k] = Modes::stuck;
  }
  const double heat = links.empty() ? 0 : go_on_together(links, held, state, notes);
  if (events.empty()) return std::max(0.0, heat);
  held = modes;
  for (const int k : events) held.slider[at(k)] = Modes::stuck;
  const double together = std::max(0.0, heat + go_on_together(events, held, state, notes));
  if (network_.trains.empty()) return together;
  // Where one node of a train has stopped, the others follow.
  const double before = kinetic_energy(state);
  const std::vector<double> none(structure_.kind.size(), 0);
  share_impulses(t, none, none, state, &held);
  return together + std::max(0.0, before - kinetic_energy(state));
}

/// Gives the nodes that sticking sliders join, one of them among `joining`, their common velocity. Returns the energy that this
/// turns into heat [J].
double EventTransition::go_on_together(const std::vector<int>& joining, const Modes& held, State& state, std::vector<std::string>& notes) const {
  double heat = 0;
  std::vector<std::vector<NodeId>> around(structure_.kind.size());
  for (std::size_t k = 0; k < held.slider.size(); ++k) {
    if (held.slider[k] != Modes::stuck) continue;
    const Branch& b = network_.sliders[k].branch;
    around[at(b.a)].push_back(b.b);
    around[at(b.b)].push_back(b.a);
  }
  std::vector<char> seen(structure_.kind.size(), 0);
  for (int k : joining) {
    std::vector<NodeId> cluster{network_.sliders[at(k)].branch.a};
    if (seen[at(cluster[0])]) continue;
    seen[at(cluster[0])] = 1;
    double momentum = 0, mass = 0, known = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t c = 0; c < cluster.size(); ++c) {
      const NodeId node = cluster[c];
      if (structure_.kind[at(node)] == Kind::known) {
        known = given_velocity(node);
      }
      momentum += structure_.mass[at(node)] * state.velocity[at(node)];
      mass += structure_.mass[at(node)];
      for (NodeId other : around[at(node)]) {
        if (seen[at(other)]) continue;
        seen[at(other)] = 1;
        cluster.push_back(other);
      }
    }
    if (std::isnan(known) && mass == 0) continue;
    const double after = std::isnan(known) ? momentum / mass : known;
    double lost = 0, had = 0;
    for (NodeId node : cluster) {
      const double before = state.velocity[at(node)], m = structure_.mass[at(node)];
      if (std::isnan(known)) lost += m * (before - after) * (before + after) / 2;
      had += m * before * before / 2;
      state.velocity[at(node)] = after;
    }
    heat += lost;
    if (const Network::Slider& link = network_.sliders[at(k)]; is_rigid_link(link) && lost > numerics::equal_energies * had) {
      notes.push_back(fmt::format(
          "{} `{}` joins masses that start with different velocities: they go on together at {}, and lose {:.6g} J "
          "at once, before the energy account begins",
          link.component && link.component->ratio ? "transmission" : "rigid link", network_.name_of(link.branch), with_unit(*network_.scene, network_.element_of(link.branch), after, Quantity::velocity), lost));
    }
  }
  return heat;
}

}  // namespace rheonet
