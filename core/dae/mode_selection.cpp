#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/mode_selection.hpp"
#include "core/dae/train_force_trials.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

std::vector<int> EventTransition::select_modes(double t, double h, const Fired& fired, State& state, Modes& modes,
                                std::vector<double>& force, Change& change) {
  const std::size_t nodes = structure_.kind.size();
  inputs_.sense(t, state);
  for (std::size_t m = 0; m < network_.motions.size(); ++m) {
    double& velocity = state.velocity[at(network_.motions[m].node)];
    const double before = std::exchange(velocity, inputs_.velocity[m]);
    // Two pieces of a signal meet to an ulp: what sticks to the motion follows, or it would slip by that ulp.
    if (std::abs(velocity - before) <= numerics::equal_velocities * std::abs(before)) std::replace(state.velocity.begin(), state.velocity.end(), before, double(velocity));
  }
  const Nodal now = nodal(state, force, true);
  stop_at_turns(fired, modes, state);
  const auto ahead = [&](double step) {
    ModeSelection selection = look_ahead(t, step, fired, state, modes, force, now);
    if (!inputs_.blocks().senses_velocities()) return selection;
    // Forces and bounds that blocks compute from velocities change with the accelerations. A first solution gives these.
    std::vector<double> acceleration(nodes, 0);
    for (std::size_t n = 0; n < nodes; ++n) {
      if (structure_.kind[n] == Kind::massive) acceleration[n] = selection.problem.change(slot(static_cast<NodeId>(n))) / step;
    }
    inputs_.accelerate(acceleration);
    inputs_.evaluate(t);
    return look_ahead(t, step, fired, state, modes, force, now);
  };
  ModeSelection selection = ahead(h);
  const double least = std::max(time_roundoff(t), numerics::present_step * h);
  if (breaks_loose(selection) && h > least && !breaks_loose(ahead(least))) {
    while (breaks_loose(selection)) selection = ahead(h = std::max(least, numerics::onset_step_ratio * h));
  }
  // Not much shorter: round-off of the dashpots' forces would hide the changes of the springs' forces.
  const double shortest = std::max(least, numerics::onset_step_ratio * numerics::onset_step_ratio * h);
  while (stops_within(selection, state) && h > shortest) selection = ahead(h = std::max(shortest, numerics::onset_step_ratio * h));
  const ConvexNetwork& problem = selection.problem;
  refuse_blocked_motions(t, problem);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (structure_.kind[n] != Kind::massive) state.velocity[n] = problem.value(slot(static_cast<NodeId>(n)));
  }
  take_directions(selection, state, change);
  std::vector<int> broken;
  DisjointSets given(nodes), held(nodes);  // of nodes; of their places in the problem
  join_given(problem, given);
  for (std::size_t n = 0; n < nodes; ++n) held.join(slot(static_cast<NodeId>(n)), slot(given.find(static_cast<NodeId>(n))));
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    if (holds(selection, k)) held.join(slot(network_.sliders[k].branch.a), slot(network_.sliders[k].branch.b));
  }
  problem.join_by_equations(held);
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    // A slider at its bound, while others hold its ends, sticks: the forces of all of them are those of least norm.
    const bool sticks = held.find(slot(b.a)) == held.find(slot(b.b)) && problem.difference(slot(b.a), slot(b.b)) == 0 && !broken_[k];
    const int direction = apart(k) ? Modes::forward : sticks ? 0 : problem.direction(selection.slider[k]);
    modes.slider[k] = static_cast<signed char>(direction);
    if (direction != 0 && bound(k, direction) > inputs_.box(k).at(direction).sliding.value) broken.push_back(static_cast<int>(k));
  }
  for (int k : let_slip(problem, selection.h, selection.law, selection.slider, selection.bound_side, selection.at_rest, fired, modes, change)) {
    const int direction = modes.slider[at(k)];
    if (bound(at(k), direction) > inputs_.box(at(k)).at(direction).sliding.value) broken.push_back(k);
  }
  rest_beside_sliders(fired, state, modes);
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    const Network::Train& train = network_.trains[k];
    if (train.loss) modes.b_drives[k] = selection.loss[k].b_drives(modes.slider[at(train.friction)], selection.train_force[k]);
  }
  return broken;
}

EventTransition::ModeSelection EventTransition::look_ahead(double t, double h, const Fired& fired, const State& state, const Modes& modes,
                                   const std::vector<double>& force, const Nodal& now) {
  double forces = 0;
  for (const Network::Train& train : network_.trains) {
    for (const NodeId node : train.node) forces = std::max(forces, now.magnitude[at(node)]);
  }
  const auto forces_of_trains = [&](const ModeSelection& selection) {
    std::vector<double> result = selection.problem.forces_of_equations();
    for (std::size_t k = 0; k < result.size(); ++k) result[k] += state.train_force[k];
    return result;
  };
  const auto follow = [&](TrainForceTrials trials) -> std::optional<ModeSelection> {
    while (!trials.endless()) {
      ModeSelection selection = look_ahead(t, h, fired, state, modes, force, now, trials.trial());
      selection.train_force = forces_of_trains(selection);
      if (trials.agree(selection.train_force, selection.problem.largest_force())) return selection;
    }
    return {};
  };
  if (auto found = follow({network_, inputs_, state.train_force, forces})) return *std::move(found);
  // Trials that lead nowhere begin anew where all gears with losses stand still: self-locking may hold them.
  if (auto found = follow({network_, inputs_, forces_of_trains(look_ahead(t, h, fired, state, modes, force, now, {})), forces})) return *std::move(found);
  for (TrainForceTrials& trials : TrainForceTrials::around(network_, inputs_, forces)) {
    if (auto found = follow(std::move(trials))) return *std::move(found);
  }
  report_losses(network_, at_time(*network_.scene, t));
}

EventTransition::ModeSelection EventTransition::look_ahead(double t, double h, const Fired& fired, const State& state, const Modes& modes,
                                   const std::vector<double>& force, const Nodal& now, const std::vector<double>& train_force) {
  const std::size_t nodes = structure_.kind.size();
  ModeSelection selection{.t = t, .h = h, .fired = &fired, .modes = &modes, .force = &force, .now = &now,
              .problem = ConvexNetwork(static_cast<int>(nodes)), .slope_around = std::vector<double>(nodes, 0),
              .law = std::vector<int>(state.p.size(), -1), .creep = std::vector<double>(state.p.size()),
              .at_rest = std::vector<double>(state.p.size()), .slider = std::vector<int>(network_.sliders.size()),
              .bound_side = std::vector<int>(network_.sliders.size()), .train_force = train_force, .loss = {}};
  add_nodes(selection, state);
  add_inputs(selection);
  add_deflection_laws(selection, state);
  add_rate_laws(selection, state);
  add_inerters(selection);
  add_trains(selection.problem, std::vector<double>(network_.trains.size(), 0));
  add_sliders(selection);
  if (const ConvexNetwork::Outcome outcome = selection.problem.solve(); outcome != ConvexNetwork::Outcome::solved) {
    if (outcome == ConvexNetwork::Outcome::unbounded) report_runaway(t, selection.problem.runaways(), state);
    report_undecided(network_, at_time(*network_.scene, t));
  }
  return selection;
}

/// Whether a slider joins its ends after the event.
bool EventTransition::holds(const ModeSelection& selection, std::size_t slider) const {
  return selection.problem.direction(selection.slider[slider]) == 0 && !apart(slider);
}

/// Whether some slider begins to slip although its force was within its bounds, or one that came to rest slips back. Between prescribed
/// motions it slips as they do.
bool EventTransition::breaks_loose(const ModeSelection& selection) const {
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    const ConvexNetwork::Bounds bounds = selection.problem.bounds(selection.slider[k]);
    const int direction = selection.problem.direction(selection.slider[k]);
    const bool within = selection.modes->slider[k] == Modes::stuck && bounds.low < 0 && bounds.high > 0 && !at_loss(selection, k);
    if (direction != 0 && (within || (direction == -came_to_rest_[k] && !prescribed(network_.sliders[k].branch)))) return true;
  }
  return false;
}

/// Whether a slider stands for losses of a gear and is at a bound, as it is without a load on the gear. At the end of h its bounds follow from the load there.
bool EventTransition::at_loss(const ModeSelection& selection, std::size_t slider) const {
  const int train = network_.sliders[slider].train;
  if (train < 0) return false;
  double size = 0;
  for (const NodeId node : network_.trains[at(train)].node) size = std::max(size, selection.now->magnitude[at(node)]);
  const double force = (*selection.force)[slider];
  return std::min(bound(slider, 1) - force, bound(slider, -1) + force) <= numerics::balance_roundoff * size;
}

/// Whether a slipping slider between nodes with masses stops during the time h, rather than at the event.
bool EventTransition::stops_within(const ModeSelection& selection, const State& state) const {
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (selection.modes->slider[k] == Modes::stuck || came_to_rest_[k] != 0 || massless(b.a) || massless(b.b) || !holds(selection, k)) continue;
    const double va = state.velocity[at(b.a)], vb = state.velocity[at(b.b)];
    if (std::abs(va - vb) > numerics::equal_velocities * (std::abs(va) + std::abs(vb))) return true;
  }
  return false;
}

void EventTransition::take_directions(const ModeSelection& selection, const State& state, Change& change) {
  const ConvexNetwork& problem = selection.problem;
  const std::vector<int>& index = selection.law;
  const Fired& fired = *selection.fired;
  DisjointSets stuck(structure_.kind.size());
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (holds(selection, k)) stuck.join(b.a, b.b);
  }
  const std::vector<NodeId> given = given_in(stuck);
  // By sticking sliders, or by known nodes of equal velocity.
  const auto kept_together = [&](const Branch& b) {
    const NodeId a = stuck.find(b.a), c = stuck.find(b.b), of_a = given[at(a)], of_b = given[at(c)];
    return a == c || (of_a >= 0 && of_b >= 0 && same_velocity(problem, of_a, of_b));
  };
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const int j = laws.first + static_cast<int>(i);
      if (index[at(j)] < 0 || laws.batch->events(i) == 0 || contains(fired.starts, j) || reversed(fired, j)) continue;
      const Branch& b = network_.deflections[at(j)];
      const double w = problem.difference(slot(b.a), slot(b.b));
      // Where a law can be held at rest the balance has decided, and the smallest velocity counts: a pseudoplastic dashpot in
      // parallel has a force at it.
      const auto [low, high] = problem.bounds(index[at(j)]);
      const bool at_rest = low < high && may_stand(j)
                               ? problem.joined(slot(b.a), slot(b.b)) || kept_together(b)
                               : same_velocity(problem, b.a, b.b);
      const int direction = at_rest ? 0 : problem.direction(index[at(j)]);
      if (direction == 0) {
        if (may_stand(j) && !kept_together(b) &&
            relaxes_from_bound(problem, index[at(j)], *laws.batch, i, state.p[at(j)])) {
          laws.batch->set_direction(i, state.p[at(j)], 0, laws.batch->direction(i));
        } else if (may_stand(j) && low < high) {
          change.sliding_modes.push_back({j, 0});
        } else if (!laws.batch->fits(i, 0)) {
          laws.batch->set_direction(i, state.p[at(j)], 0, 0);
        }
      } else if (!laws.batch->fits(i, w)) {
        laws.batch->set_direction(i, state.p[at(j)], w, direction);
      }
    }
  }
}

bool EventTransition::same_velocity(const ConvexNetwork& problem, NodeId a, NodeId b) const {
  const double speeds = std::abs(problem.value(slot(a))) + std::abs(problem.value(slot(b)));
  return std::abs(problem.difference(slot(a), slot(b))) <= numerics::equal_velocities * speeds;
}

/// For each set, at the index of the node that represents it: a known node of the set, or -1.
std::vector<NodeId> EventTransition::given_in(DisjointSets& sets) const {
  std::vector<NodeId> result(structure_.kind.size(), -1);
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (structure_.kind[n] == Kind::known) result[at(sets.find(static_cast<NodeId>(n)))] = static_cast<NodeId>(n);
  }
  return result;
}

/// Whether friction at its bound, where its slope is 0, is about to leave the bound in its present direction. It could stay,
/// but the least disturbance would end that. In parallel with a sticking slider it rests instead.
bool EventTransition::relaxes_from_bound(const ConvexNetwork& problem, int branch, const DeflectionBatch& batch, std::size_t i, double p) {
  const int direction = batch.direction(i);
  if (direction == 0 || !(batch.slope(i, p, direction) <= numerics::flat_slope * batch.slope(i, p, -direction))) return false;
  const auto [low, high] = problem.bounds(branch);
  return std::abs(problem.force(branch) - (direction > 0 ? high : low)) <= numerics::flat_slope * (high - low);
}

bool EventTransition::reversed(const Fired& fired, int branch) const {
  const Branch& b = network_.deflections[at(branch)];
  return contains(fired.turns, branch) && (massless(b.a) || massless(b.b)) && !may_stand(branch);
}

double EventTransition::delayed_slope(int branch, const State& state) const {
  std::size_t i = 0;
  return network_.batch_of(branch, i).slope(i, state.p[at(branch)], 0);
}

bool EventTransition::may_stand(int branch) const {
  const Branch& b = network_.deflections[at(branch)];
  if (!massless(b.a) && !massless(b.b)) return false;
  std::size_t i = 0;
  return network_.batch_of(branch, i).can_hold(i);
}

}  // namespace rheonet
