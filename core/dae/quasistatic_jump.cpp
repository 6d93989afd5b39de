#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/dashpot_steps.hpp"
#include "core/dae/event_transition.hpp"
#include "core/network/adjacent_elements.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

void EventTransition::position_steps(double t, std::vector<double>& dx, std::vector<double>& momentum, const State& state,
                                     std::vector<std::string>& notes) {
  for (std::size_t m = 0; m < network_.motions.size(); ++m) dx[at(network_.motions[m].node)] = inputs_.steps()[m];
  if (std::all_of(dx.begin(), dx.end(), [](double step) { return step == 0; })) return;
  const Structure led = take_along(t, dx);
  if (!go_with_dashpots(network_, led, dx)) report_hidden_shares(t);
  momentum = momentum_through_dashpots(network_, led, dx, t);
  for (const Network::Inerter& inerter : network_.inerters) {
    const Branch& b = inerter.branch;
    if (step_together(dx[at(b.a)], dx[at(b.b)])) continue;
    throw SimulationError(network_.spot_of(b.element),
                          fmt::format("{} a step in position stretches inerter `{}` by {} in no time, which takes a force beyond any bound; "
                                      "give the step a time to rise in",
                                      at_time(*network_.scene, t), network_.name_of(b),
                                      with_unit(*network_.scene, network_.element_of(b), dx[at(b.a)] - dx[at(b.b)], Quantity::position)));
  }
  for (const Network::Train& train : network_.trains) {
    double sum = 0, size = 0;
    for (std::size_t i = 0; i < train.node.size(); ++i) {
      sum += train.factor[i] * dx[at(train.node[i])];
      size += std::abs(train.factor[i] * dx[at(train.node[i])]);
    }
    if (std::abs(sum) <= numerics::equal_given_values * size) continue;
    throw SimulationError(network_.spot_of(train.element),
                          fmt::format("{} a step in position turns transmission `{}` in no time, which takes a force beyond any bound; give the step a time "
                                      "to rise in",
                                      at_time(*network_.scene, t), network_.scene->elements[at(train.element)].name));
  }
  refuse_steps_through_contacts(t, dx, state);
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (network_.sliders[k].contact) continue;
    const double by = dx[at(b.a)] - dx[at(b.b)];
    if (massless(b.a) || massless(b.b) || step_together(dx[at(b.a)], dx[at(b.b)]) || is_rigid_link(network_.sliders[k])) continue;
    if (!std::isinf(inputs_.box(k).at(by < 0 ? -1 : 1).sliding.value)) continue;
    throw SimulationError(network_.spot_of(b.element),
                          fmt::format("{} a step in position turns `{}` backwards by {} in no time, which takes a force beyond any bound; give "
                                      "the step a time to rise in",
                                      at_time(*network_.scene, t), network_.name_of(b), with_unit(*network_.scene, network_.element_of(b), std::abs(by), Quantity::position)));
  }
  const auto tell = [&](int element, const std::string& what, double by, const char* whose) {
    char& told = impulse_told_[at(element)];
    if (std::exchange(told, 1)) return;
    notes.push_back(fmt::format("{} a step in position moves {} by {} in no time: {} force at such a step is an "
                                "impulse, which no row shows and the energy account leaves out",
                                at_time(*network_.scene, t), what, with_unit(*network_.scene, network_.scene->elements[at(element)], by, Quantity::position), whose));
  };
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      if (laws.batch->impulse(i) == 0 || step_together(dx[at(b.a)], dx[at(b.b)])) continue;
      tell(b.element, fmt::format("dashpot `{}`", network_.name_of(b)), dx[at(b.a)] - dx[at(b.b)], "its");
    }
  }
  for (const Network::Mass& mass : network_.masses) {
    const double by = dx[at(mass.node)];
    if (by == 0 || led.kind[at(mass.node)] != Kind::known) continue;
    tell(mass.element, fmt::format("mass `{}`", network_.scene->elements[at(mass.element)].name), by, "the motion's");
  }
}

/// Sums over the nodes that move as one at an event, at the node that represents them.
EventTransition::Nodal EventTransition::together(const Nodal& single) const {
  const std::vector<double> none(single.sum.size(), 0);
  Nodal result{none, none, none};
  for (std::size_t n = 0; n < none.size(); ++n) {
    const std::size_t speaks = at(speaker(static_cast<NodeId>(n)));
    result.sum[speaks] += single.sum[n];
    result.magnitude[speaks] += single.magnitude[n];
    result.rounding[speaks] += single.rounding[n];
  }
  return result;
}

// At an event forces stay finite: masses and the nodes held by dashpots keep their places. Floating nodes move to where the
// forces balance, along the laws' own curves and against the friction of the sliders.
std::optional<EventTransition::Jump> EventTransition::find_jump(const std::vector<double>& dx, const State& state,
                                                const std::vector<double>& force, bool along) const {
  bool needed = std::any_of(dx.begin(), dx.end(), [](double d) { return d != 0; });
  if (!needed && structure_.groups.empty()) return std::nullopt;
  const std::size_t nodes = structure_.kind.size();
  const auto [sum, magnitude, rounding] = together(nodal(state, force, false));
  std::vector<double> slack(nodes, 0);
  for (std::size_t n = 0; n < nodes; ++n) slack[at(speaker(static_cast<NodeId>(n)))] += slack_[n];
  ConvexNetwork problem(static_cast<int>(nodes));
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto node = static_cast<NodeId>(n);
    if (structure_.group[n] < 0) {
      problem.fix(slot(node), dx[n]);
    } else if (speaker(node) != node) {
      problem.fix(slot(node), 0);
    } else if (const double out = std::abs(sum[n]) - slack[n]; out > numerics::balance_roundoff * magnitude[n] + rounding[n]) {
      problem.load(slot(node), -std::copysign(out, sum[n]));
      needed = true;
    }
  }
  const auto light = [&](const Branch& b) { return structure_.group[at(b.a)] >= 0 || structure_.group[at(b.b)] >= 0; };
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    needed = needed || (light(b) && std::abs(force[k]) > bound(k, force[k] > 0 ? 1 : -1) * (1 + numerics::balance_roundoff));
  }
  if (!needed) return std::nullopt;

  std::vector<double> f(state.p.size()), c(f);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &c[at(laws.first)]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const NodeId a = speaker(network_.deflections[j].a), b = speaker(network_.deflections[j].b);
      if (carried(a, b) || laws.batch->delay(i) > 0) continue;
      const DeflectionBatch& batch = *laws.batch;
      const double p = state.p[j], f0 = f[j];
      if (along) {
        const double slope = batch.slope(i, p, batch.direction(i));
        problem.add(slot(a), slot(b), {.backward = slope, .forward = slope, .rounding = std::max(std::abs(f0), force_of_deflection(batch, i, p))});
        continue;
      }
      problem.add(slot(a), slot(b), {.backward = batch.slope(i, p, -1), .forward = batch.slope(i, p, 1),
                         .rounding = std::max(std::abs(f0), force_of_deflection(batch, i, p)),
                         .beyond = [&batch, i, p, f0](double step, double& slope) {
                           return batch.force_along(i, p, step, slope) - f0;
                         }});
    }
  }
  std::vector<int> slider_branch(network_.sliders.size(), -1);
  for (std::size_t k = 0; k < slider_branch.size(); ++k) {
    const NodeId a = speaker(network_.sliders[k].branch.a), b = speaker(network_.sliders[k].branch.b);
    if (carried(a, b)) continue;
    slider_branch[k] = problem.add(slot(a), slot(b), {.low = -bound(k, -1) - force[k], .high = bound(k, 1) - force[k]});
  }
  const ConvexNetwork::Outcome outcome = problem.solve();
  return Jump{std::move(problem), outcome, std::move(slider_branch)};
}

void EventTransition::report_unbalanced(double t) const {
  std::vector<NodeId> nodes;
  std::vector<std::string> names;
  for (NodeId n = 0; at(n) < structure_.kind.size(); ++n) {
    if (structure_.group[at(n)] < 0) continue;
    nodes.push_back(n);
    names.push_back(network_.node_name(n));
  }
  throw SimulationError(network_.spot_of_node(nodes.front()), fmt::format(
      "{} the forces at massless node{} {} cannot be balanced: the values of {} may lie too far apart for double precision; check "
      "them, or give the node{} a mass or a dashpot",
      at_time(*network_.scene, t), names.size() > 1 ? "s" : "", format_list(names), format_list(elements_at(network_, nodes)),
      names.size() > 1 ? "s" : ""));
}

void EventTransition::report_hidden_shares(double t) const {
  std::vector<std::string> motions, dashpots;
  std::optional<Spot> where;
  for (std::size_t m = 0; m < network_.motions.size(); ++m) {
    if (inputs_.steps()[m] == 0) continue;
    if (!where) where = network_.spot_of(network_.motions[m].element);
    motions.push_back(network_.scene->elements[at(network_.motions[m].element)].name);
  }
  for (const Branch& b : network_.rates) {
    if (massless(b.a) || massless(b.b)) dashpots.push_back(network_.name_of(b));
  }
  throw SimulationError(where.value(), fmt::format(
      "{} rounding hides how dashpots {} share the step in position of {}: their values lie too far apart; give the step a time to "
      "rise in",
      at_time(*network_.scene, t), format_list(dashpots), format_list(motions)));
}

double EventTransition::farthest(const Jump& jump) const {
  double most = 0;
  for (const Branch& b : network_.deflections) {
    most = std::max(most, std::abs(moved(jump, b.a) - moved(jump, b.b)));
  }
  return most;
}

/// True if each deflection changes by no more than a share of itself that may be an error of steps. Laws at their bounds do not count: their
/// forces stay, however far they move.
bool EventTransition::hardly_moves(const Jump& jump, const State& state) const {
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double step = moved(jump, network_.deflections[j].a) - moved(jump, network_.deflections[j].b);
      if (!laws.batch->constant(i) && std::abs(step) > numerics::step_error_of_balance * std::abs(state.p[j])) return false;
    }
  }
  return true;
}

void EventTransition::displace(double t, const Jump& jump, State& state) const {
  std::vector<double> distance(state.position.size());
  for (std::size_t n = 0; n < distance.size(); ++n) state.position[n] += distance[n] = moved(jump, static_cast<NodeId>(n));
  inputs_.history().moved(t, distance);
}

bool EventTransition::settle_errors(double t, State& state, std::vector<double>& force) const {
  if (structure_.groups.empty()) return false;
  const Nodal now = together(nodal(state, force, false));
  for (std::size_t n = 0; n < now.sum.size(); ++n) {
    if (structure_.group[n] >= 0 && std::abs(now.sum[n]) > numerics::step_error_of_balance * now.magnitude[n]) return false;
  }
  const std::vector<double> still(structure_.kind.size(), 0);
  const std::optional<Jump> back = find_jump(still, state, force), along = find_jump(still, state, force, true);
  if (!along || along->outcome != ConvexNetwork::Outcome::solved || back->outcome != ConvexNetwork::Outcome::solved) return false;
  if (farthest(*along) > numerics::distant_balance * farthest(*back) && !hardly_moves(*along, state)) return false;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      if (!(laws.batch->delay(i) > 0)) state.p[j] += moved(*along, network_.deflections[j].a) - moved(*along, network_.deflections[j].b);
    }
  }
  for (std::size_t k = 0; k < force.size(); ++k) {
    if (along->slider_branch[k] >= 0) force[k] += along->problem.force(along->slider_branch[k]);
  }
  displace(t, *along, state);
  return true;
}

bool EventTransition::jump(double t, bool stepped, std::vector<double>& dx, State& state, std::vector<double>& force, Change& change) {
  std::optional<Jump> found = find_jump(dx, state, force);
  if (!found) return false;
  const auto& [problem, outcome, slider_branch, share] = *found;
  if (outcome == ConvexNetwork::Outcome::unbounded) report_runaway(t, problem.runaways(), state);
  if (outcome != ConvexNetwork::Outcome::solved) {
    report_unbalanced(t);
  }

  found->share = share_to_contact(*found, state);
  for (double& d : dx) d *= 1 - share;
  const auto moved = [&](NodeId node) { return this->moved(*found, node); };
  double stored = 0, work = 0, heat = 0, delayed = 0, slope;
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double step = moved(network_.deflections[j].a) - moved(network_.deflections[j].b);
      if (step == 0) continue;
      if (laws.batch->delay(i) > 0) {
        delayed += laws.batch->force_along(i, state.p[j], 0, slope) * step;  // the law does not know of the step yet
        continue;
      }
      stored -= laws.batch->stored_energy(i, state.p[j]);
      heat += laws.batch->jump(i, state.p[j], step);
      state.p[j] += step;
      stored += laws.batch->stored_energy(i, state.p[j]);
    }
  }
  for (std::size_t k = 0; k < slider_branch.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double step = moved(b.a) - moved(b.b);
    if (step != 0 && !network_.sliders[k].contact) heat += inputs_.box(k).at(step > 0 ? 1 : -1).sliding.value * std::abs(step);
    if (slider_branch[k] < 0) continue;
    if (step != 0) broken_[k] = 1;
    force[k] += share * problem.force(slider_branch[k]);
  }
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& load = network_.forces[k];
    work += inputs_.force[k] * (moved(load.a) - (load.b < 0 ? 0 : moved(load.b)));
  }
  // A step of the inputs does the work that it takes; without a step, lost energy becomes heat.
  change.heat += delayed + (stepped ? heat : std::max(0.0, work - stored - delayed));
  displace(t, *found, state);
  return true;
}

}  // namespace rheonet
