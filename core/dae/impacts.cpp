#include "core/dae/impacts.hpp"

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
#include "core/dae/convex.hpp"
#include "core/dae/torn_links.hpp"
#include "core/network/overload_report.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

namespace {

/// A velocity that an impulse has reduced to this share has stopped: it is round-off.
constexpr double stopped = numerics::sum_ulps * std::numeric_limits<double>::epsilon();

double kinetic_energy(const EventNetwork& net, const State& state) {
  double sum = 0;
  for (std::size_t n = 0; n < net.structure.kind.size(); ++n) {
    if (net.structure.kind[n] == Kind::massive) sum += net.structure.mass[n] * state.velocity[n] * state.velocity[n] / 2;
  }
  for (const auto& [branch, inertance] : net.network.inerters) {
    const double w = state.velocity[at(branch.a)] - state.velocity[at(branch.b)];
    sum += inertance * w * w / 2;
  }
  return sum;
}

std::vector<std::string> names_of(const Network& network, const std::vector<int>& sliders) {
  std::vector<std::string> names;
  for (const int k : sliders) names.push_back(network.name_of(network.sliders[at(k)].branch));
  return names;
}

std::vector<double> slips_of_trains(const Network& network, const std::vector<double>& velocity) {
  std::vector<double> result;
  for (const Network::Train& train : network.trains) {
    double sum = 0;
    for (std::size_t i = 0; i < train.node.size(); ++i) sum += train.factor[i] * velocity[at(train.node[i])];
    result.push_back(sum);
  }
  return result;
}

std::vector<double> slider_velocities(const EventNetwork& net, const State& state) {
  std::vector<double> w;
  for (const Network::Slider& slider : net.network.sliders) w.push_back(net.velocity(slider.branch.a, state) - net.velocity(slider.branch.b, state));
  return w;
}

/// For each node, those that sticking sliders join to it.
std::vector<std::vector<NodeId>> held_together(const EventNetwork& net, const Modes& held) {
  std::vector<std::vector<NodeId>> around(net.structure.kind.size());
  for (std::size_t k = 0; k < held.slider.size(); ++k) {
    if (held.slider[k] != Modes::stuck) continue;
    const Branch& b = net.network.sliders[k].branch;
    around[at(b.a)].push_back(b.b);
    around[at(b.b)].push_back(b.a);
  }
  return around;
}

/// Sliders between masses or prescribed nodes that move in a direction in which they have no bound.
std::vector<int> moving_backwards(const EventNetwork& net, const State& state) {
  std::vector<int> result;
  for (std::size_t k = 0; k < net.network.sliders.size(); ++k) {
    const auto& [element, a, b] = net.network.sliders[k].branch;
    // An impact goes on through nodes without mass that are in contact with others.
    const bool firm = (!net.massless(a) && !net.massless(b)) || net.network.sliders[k].contact;
    if (net.prescribed(net.network.sliders[k].branch) || !firm || is_rigid_link(net.network.sliders[k])) continue;
    const double va = net.velocity(a, state), vb = net.velocity(b, state);
    const bool never = std::isinf(net.inputs.box(k).at(va < vb ? -1 : 1).sliding.value);
    if (never && std::abs(va - vb) > numerics::equal_energies * (std::abs(va) + std::abs(vb))) result.push_back(static_cast<int>(k));
  }
  return result;
}

}  // namespace

void Impacts::resolve(double t, const std::vector<double>& momentum, const FiredGuards& fired, const Modes& modes, State& state,
                      EventChange& change) {
  // At the start, nodes that rigid links join need not have one velocity.
  const bool start = !started_;
  if (start) change.heat += halt(t, {}, modes, state, change.notes);
  const std::vector<double> before = start ? std::vector<double>(network_.sliders.size(), 0) : slider_velocities(net_, state);
  change.heat += collide(t, momentum, fired.settles, state, change);
  std::vector<int> together = closed_but_for_roundoff(fired.settles, state);
  together.insert(together.begin(), fired.sliders.begin(), fired.sliders.end());
  for (const double v : state.velocity) largest_speed_ = std::max(largest_speed_, std::abs(v));
  change.heat += halt(t, together, without_moved(modes, before, state), state, change.notes);
}

/// The modes, without the sticking of sliders that an impact has set in motion; `before`: their velocities before it [m/s].
Modes Impacts::without_moved(Modes modes, const std::vector<double>& before, const State& state) const {
  const std::vector<double> after = slider_velocities(net_, state);
  for (std::size_t k = 0; k < after.size(); ++k) {
    if (std::abs(after[k] - before[k]) > numerics::equal_energies * largest_speed_) modes.slider[k] = Modes::forward;
  }
  return modes;
}

/// Contacts whose ends approach too slowly for an impact, or part by the round-off of an impact that gives nothing back. With this velocity,
/// mode selection would take a contact that has to push for a moment for one that stays closed, and one that stays closed for one that opens.
std::vector<int> Impacts::closed_but_for_roundoff(const std::vector<int>& settles, const State& state) const {
  std::vector<int> result;
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Network::Slider& slider = network_.sliders[k];
    const int side = slider.contact ? network_.contact_of(slider) : 0;
    if (side == 0) continue;
    const double va = net_.velocity(slider.branch.a, state), vb = net_.velocity(slider.branch.b, state);
    const bool plastic = contains(hit_, static_cast<int>(k)) && (slider.contact->restitution == 0 || contains(settles, static_cast<int>(k)));
    const bool roundoff = std::abs(va - vb) <= numerics::equal_energies * (std::abs(va) + std::abs(vb));
    if (va != vb && roundoff && (plastic || side * (va - vb) > 0)) result.push_back(static_cast<int>(k));
  }
  return result;
}

/// Gives masses the momentum of dashpots at steps in position [N s], and passes on the jumps of prescribed velocities through
/// inerters. Ends motions that a law forbids (a freewheel turned backwards by a step, or at the start; a rigid stop that is hit): an impact.
/// Returns the energy that this turns into heat [J].
double Impacts::collide(double t, const std::vector<double>& momentum, const std::vector<int>& settles, State& state, EventChange& change) {
  std::vector<double> jump(structure_.kind.size(), 0);  // of the velocity of each prescribed node
  // At the start the state does not have these velocities yet: nothing jumps.
  for (std::size_t n = 0; started_ && n < jump.size(); ++n) {
    if (net_.leader(static_cast<NodeId>(n)) >= 0) jump[n] = net_.given_velocity(net_.leader(static_cast<NodeId>(n))) - state.velocity[n];
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
  std::vector<int> backwards = moving_backwards(net_, state);
  hit_.clear();
  largest_kinetic_ = std::max(largest_kinetic_, kinetic_energy(net_, state));
  if (backwards.empty()) return turned;
  const double lost = std::max(0.0, rebound(t, backwards, settles, state));
  const auto in_contact = [&](int k) { return network_.sliders[at(k)].contact.has_value(); };
  std::copy_if(backwards.begin(), backwards.end(), std::back_inserter(hit_), in_contact);
  std::erase_if(backwards, in_contact);
  if (!hit_.empty()) open_parted(settles, state, change);
  // A freewheel that ceases to run ahead has the round-off of its event as its velocity: no impact.
  const bool impact = lost > numerics::equal_energies * largest_kinetic_;
  if (t == 0 && impact && !hit_.empty()) {
    change.notes.push_back(fmt::format("{} {} start with an impact, which turns {:.6g} J into heat, before the energy account begins",
                                       at_time(*network_.scene, t), "the ends of " + format_list(names_of(network_, hit_)), lost));
  }
  if (backwards.empty() || (!impact && t > 0)) return turned + lost;
  const std::vector<std::string> names = names_of(network_, backwards);
  change.notes.push_back(fmt::format("{} {} would move backwards: {} ends go on together from there{}", at_time(*network_.scene, t), format_list(names),
                              names.size() > 1 ? "their" : "its",
                              impact ? fmt::format(", which turns {:.6g} J into heat{}", lost, t > 0 ? "" : ", before the energy account begins") : ""));
  return turned + lost;
}

/// Contacts whose ends an impact has thrown back, or left behind by what it took from a third body, are apart, however short the hop is:
/// mode selection looks further ahead.
void Impacts::open_parted(const std::vector<int>& settles, State& state, EventChange& change) const {
  const std::vector<double> w = slider_velocities(net_, state);
  for (std::size_t k = 0; k < w.size(); ++k) {
    const Network::Slider& slider = network_.sliders[k];
    const auto& [element, a, b] = slider.branch;
    const int side = slider.contact ? network_.contact_of(slider) : 0;
    if (side == 0 || contains(settles, static_cast<int>(k))) continue;
    const bool hit = contains(hit_, static_cast<int>(k));
    const bool stays = hit ? slider.contact->restitution == 0 : net_.massless(a) || net_.massless(b);
    const double roundoff = hit ? 0 : numerics::equal_energies * (std::abs(net_.velocity(a, state)) + std::abs(net_.velocity(b, state)));
    if (stays || !(-side * w[k] > roundoff)) continue;
    count_from_contact(network_, slider, state);
    open_contact(network_, slider);
    if (hit) change.impacts.push_back({element, -side});
  }
}

/// An impact, in two phases (S. D. Poisson 1838). First all contacts take the impulses that end the motions they forbid: a plastic
/// impact. Then each contact in `hit` gives back its coefficient of restitution times its impulse. So w = -e w_before at a
/// single contact, and at all that are hit at once with the same e (Newton's law). Contacts that only touch give nothing back,
/// and neither do those in `settles`, which stay in contact. Returns the energy that turns into heat [J]: the work of the impulses at the contacts.
double Impacts::rebound(double t, const std::vector<int>& hit, const std::vector<int>& settles, State& state) const {
  const std::vector<double> none(structure_.kind.size(), 0);
  std::vector<double> given(network_.sliders.size(), 0), momentum(none);
  double heat = 0;
  Modes held{std::vector<signed char>(network_.sliders.size(), Modes::forward), {}};
  for (const int k : settles) held.slider[at(k)] = Modes::stuck;
  const auto phase = [&] {
    const std::vector<double> before = slider_velocities(net_, state);
    const std::vector<double> impulse = share_impulses(t, none, momentum, state, &held);
    const std::vector<double> after = slider_velocities(net_, state);
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

/// At the start, nodes that trains join need not have velocities that fit. They go on with common momentum, and the energy that this
/// takes is heat [J].
double Impacts::turn_trains(double t, State& state, std::vector<std::string>& notes) const {
  if (network_.trains.empty()) return 0;
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    if (structure_.kind[n] == Kind::known) state.velocity[n] = net_.given_velocity(static_cast<NodeId>(n));
  }
  const std::vector<double> slips = slips_of_trains(network_, state.velocity);
  if (std::all_of(slips.begin(), slips.end(), [](double slip) { return slip == 0; })) return 0;
  const double before = kinetic_energy(net_, state);
  const std::vector<double> none(structure_.kind.size(), 0);
  share_impulses(t, none, none, state);
  const double lost = std::max(0.0, before - kinetic_energy(net_, state));
  if (lost <= numerics::equal_energies * before) return 0;
  std::vector<std::string> names;
  for (const Network::Train& train : network_.trains) names.push_back(network_.scene->elements[at(train.element)].name);
  notes.push_back(fmt::format("{} transmission{} {} join{} masses that start with velocities that do not fit: they go on together, and lose {:.6g} J at "
                              "once, before the energy account begins",
                              at_time(*network_.scene, t), names.size() > 1 ? "s" : "", format_list(names), names.size() > 1 ? "" : "s", lost));
  return lost;
}

/// Refuses an impact that would stop what a motion moves on through a train.
void Impacts::refuse_jams(double t, const ConvexNetwork& problem) const {
  const double fast = net_.inputs.reach().velocity;
  for (const Network::Train& train : network_.trains) {
    double slip = 0, size = fast;
    for (std::size_t i = 0; i < train.node.size(); ++i) {
      const double velocity = train.factor[i] * problem.value(net_.slot(train.node[i]));
      slip += velocity;
      size += std::abs(velocity);
    }
    if (std::abs(slip) > numerics::equal_energies * size) refuse_blocked_motions(net_, t, problem);
  }
}

/// Changes the velocities of masses by impulses,
///     minimise 1/2 (v - v0)' M (v - v0) - momentum' v     with     w in the permitted direction, at every law without a bound.
/// Prescribed velocities change by `jump`. Friction, springs and dashpots take no impulse, but the sliders that stick in `held` do.
/// Laws whose ends part, and still part afterwards, are left out: round-off and regularisation of their impulses would act on masses that nothing touches.
std::vector<double> Impacts::share_impulses(double t, const std::vector<double>& jump, const std::vector<double>& momentum, State& state,
                                                    const Modes* held) const {
  std::vector<double> before = state.velocity;
  for (std::size_t n = 0; n < before.size(); ++n) {
    if (structure_.kind[n] == Kind::known) before[n] = net_.given_velocity(static_cast<NodeId>(n)) - jump[n];
  }
  std::vector<double> slips = slips_of_trains(network_, before);
  for (double& slip : slips) slip = -slip;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  const auto impulse = [](const Bounds& bounds) { return std::isinf(bounds.sliding.value) ? bounds.sliding.value : 0; };
  std::vector<ConvexNetwork::Law> laws;
  std::vector<char> parts;  // its ends part, as the law permits
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const auto& [element, a, b] = network_.sliders[k].branch;
    laws.push_back({.low = -impulse(inputs_.box(k).backward), .high = impulse(inputs_.box(k).forward)});
    if (held && held->slider[k] == Modes::stuck) laws.back() = {.low = -unlimited, .high = unlimited};
    const double w = before[at(a)] - before[at(b)];
    parts.push_back(w != 0 && !laws.back().forbids(w));
  }
  std::vector<int> branch;
  const auto pose = [&] {
    ConvexNetwork problem(static_cast<int>(structure_.kind.size()));
    std::vector<char> reached(structure_.kind.size(), 0);  // by some impulse
    const auto add = [&](const Branch& b, const ConvexNetwork::Law& law) {
      reached[at(b.a)] = reached[at(b.b)] = 1;
      return problem.add(net_.slot(b.a), net_.slot(b.b), law);
    };
    for (const auto& [ends, inertance] : network_.inerters) add(ends, {.backward = inertance, .forward = inertance, .of_change = true, .inertial = true});
    branch.assign(laws.size(), -1);
    for (std::size_t k = 0; k < laws.size(); ++k) {
      if (laws[k].low < laws[k].high && !parts[k]) branch[k] = add(network_.sliders[k].branch, laws[k]);
    }
    for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
      const int node = net_.slot(static_cast<NodeId>(n));
      problem.start(node, before[n]);
      if (structure_.kind[n] == Kind::known) {
        problem.fix(node, jump[n]);
        continue;
      }
      problem.load(node, momentum[n]);
      if (structure_.kind[n] == Kind::massive) {
        problem.set_inertia(node, structure_.mass[n]);
      } else if (!reached[n]) {
        problem.fix(node, 0);
      }
    }
    net_.tie_trains(problem, slips);
    if (problem.solve() != ConvexNetwork::Outcome::solved) report_undecided(network_, at_time(*network_.scene, t));
    return problem;
  };
  ConvexNetwork problem = pose();
  for (bool again = true; again;) {
    again = false;
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const auto& [element, a, b] = network_.sliders[k].branch;
      const double w = problem.difference(net_.slot(a), net_.slot(b));
      if (!parts[k] || w == 0 || !laws[k].forbids(w)) continue;
      parts[k] = 0;
      again = true;
    }
    if (again) problem = pose();
  }
  refuse_jams(t, problem);
  std::vector<char> of_train(structure_.kind.size(), 0);  // their velocities follow from those of masses
  for (const Network::Train& train : network_.trains) {
    for (const NodeId node : train.node) of_train[at(node)] = structure_.kind[at(node)] != Kind::known;
  }
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    if (structure_.kind[n] != Kind::massive && !of_train[n]) continue;
    const double was = state.velocity[n], is = problem.value(net_.slot(static_cast<NodeId>(n)));
    state.velocity[n] = std::abs(is) <= stopped * std::abs(was) ? 0 : is;
  }
  std::vector<double> impulses(branch.size(), 0);
  for (std::size_t k = 0; k < branch.size(); ++k) {
    if (branch[k] >= 0) impulses[k] = problem.force(branch[k]);
  }
  return impulses;
}

/// Masses that sliders bring to rest against each other go on with their common momentum: what remains of their relative
/// velocity is the round-off of the event. Rigid links do so at once, and the energy that this takes is heat.
double Impacts::halt(double t, const std::vector<int>& events, const Modes& modes, State& state,
                     std::vector<std::string>& notes) const {
  refuse_torn_links(net_, t);
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
  const double before = kinetic_energy(net_, state);
  const std::vector<double> none(structure_.kind.size(), 0);
  share_impulses(t, none, none, state, &held);
  return together + std::max(0.0, before - kinetic_energy(net_, state));
}

/// The velocities of given motions, and of the nodes that sticking sliders hold to these without the help of `joining`; NaN for all others. Two motions
/// that come to one velocity may differ by the round-off of the time.
std::vector<double> Impacts::held_to_motions(const std::vector<int>& joining, const Modes& held) const {
  Modes others = held;
  for (const int k : joining) others.slider[at(k)] = Modes::forward;
  const std::vector<std::vector<NodeId>> around = held_together(net_, others);
  std::vector<double> velocity(structure_.kind.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<NodeId> reached;
  for (std::size_t n = 0; n < velocity.size(); ++n) {
    if (structure_.kind[n] != Kind::known) continue;
    velocity[n] = net_.given_velocity(static_cast<NodeId>(n));
    reached.push_back(static_cast<NodeId>(n));
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const NodeId other : around[at(reached[i])]) {
      if (!std::isnan(velocity[at(other)])) continue;
      velocity[at(other)] = velocity[at(reached[i])];
      reached.push_back(other);
    }
  }
  return velocity;
}

/// Gives the nodes that sticking sliders join, one of them among `joining`, their common velocity. Returns the energy that this
/// turns into heat [J].
double Impacts::go_on_together(const std::vector<int>& joining, const Modes& held, State& state, std::vector<std::string>& notes) const {
  double heat = 0;
  const std::vector<std::vector<NodeId>> around = held_together(net_, held);
  const std::vector<double> kept = held_to_motions(joining, held);
  std::vector<char> seen(structure_.kind.size(), 0);
  for (int k : joining) {
    std::vector<NodeId> cluster{network_.sliders[at(k)].branch.a};
    if (seen[at(cluster[0])]) continue;
    seen[at(cluster[0])] = 1;
    double momentum = 0, mass = 0, known = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t c = 0; c < cluster.size(); ++c) {
      const NodeId node = cluster[c];
      if (!std::isnan(kept[at(node)])) known = kept[at(node)];
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
      state.velocity[at(node)] = std::isnan(kept[at(node)]) ? after : kept[at(node)];
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

void Impacts::open_contacts(const Modes& modes, State& state, EventChange& change) const {
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Network::Slider& slider = network_.sliders[k];
    if (!slider.contact || apart(network_, slider)) continue;
    count_from_contact(network_, slider, state);
    if (modes.slider[k] == Modes::stuck) continue;
    const int side = network_.contact_of(slider);
    open_contact(network_, slider);
    if (contains(hit_, static_cast<int>(k))) change.impacts.push_back({slider.branch.element, -side});
  }
}

}  // namespace rheonet
