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
#include "core/dae/event_transition.hpp"
#include "core/dae/rate_law.hpp"
#include "core/dae/train_force_trials.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

// Over a short time h, with velocities v at its end, all forces counted from those at its beginning, and E, c the slope and
// creep of a law in the direction of w, the network satisfies
//
//     (m/h) (v - v0) + sum of +-[ B (w - w0),  h E (w - c),  a slider's within its bounds ] = dF - present imbalance
//
// Masses outweigh dashpots, and dashpots springs, each by 1/h: so one problem decides at the level (acceleration, velocity or
// rate of force) that determines the velocity of each slider.
struct EventTransition::ModeSelection {
  double t, h;
  const Fired* fired;
  const Modes* modes;
  const std::vector<double>* force;  // of the sliders
  const Nodal* now;                  // forces and their round-off
  ConvexNetwork problem;
  std::vector<double> slope_around;  // of each node that can move: largest slope there, without sliders and power laws
  std::vector<int> law;              // of each deflection branch: its branch of the problem; -1: delayed, hence a load
  std::vector<double> creep, at_rest;  // of each deflection branch
  std::vector<int> slider, bound_side;
  std::vector<double> train_force;  // of each train, at the end of h: the bounds of losses depend on it; empty: gears with losses stand still
  std::vector<Loss> loss;           // of each train, at the end of h

  void meet(const Structure& structure, const Branch& b, double slope) {
    for (const NodeId n : {b.a, b.b}) {
      if (structure.kind[at(n)] != Kind::known) slope_around[at(n)] = std::max(slope_around[at(n)], slope);
    }
  }
};

std::vector<int> EventTransition::select_modes(double t, double h, const Fired& fired, State& state, Modes& modes,
                                std::vector<double>& force, Change& change) {
  const std::size_t nodes = structure_.kind.size();
  inputs_.sense(t, state);
  for (std::size_t m = 0; m < network_.motions.size(); ++m) state.velocity[at(network_.motions[m].node)] = inputs_.velocity[m];
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
  const ConvexNetwork& problem = selection.problem;
  refuse_blocked_motions(t, problem);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (structure_.kind[n] != Kind::massive) state.velocity[n] = problem.value(slot(static_cast<NodeId>(n)));
  }
  take_directions(selection, state, change);
  std::vector<int> broken;
  DisjointSets held(nodes);
  join_given(problem, held);
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    if (holds(selection, k)) held.join(network_.sliders[k].branch.a, network_.sliders[k].branch.b);
  }
  hold_by_trains(held);
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    // A slider at its bound, while others hold its ends, sticks: the forces of all of them are those of least norm.
    const bool sticks = held.find(b.a) == held.find(b.b) && problem.difference(slot(b.a), slot(b.b)) == 0 && !broken_[k];
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
      if (trials.agree(selection.train_force)) return selection;
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

/// A train whose other two nodes are held together holds its last node there too, if its equation permits equal velocities. At ground it does: all are 0.
void EventTransition::hold_by_trains(DisjointSets& held) const {
  for (bool again = true; again;) {
    again = false;
    for (const Network::Train& train : network_.trains) {
      double sum = 0, size = 0;
      for (const double factor : train.factor) {
        sum += factor;
        size += std::abs(factor);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const NodeId last = train.node[i], one = train.node[(i + 1) % 3], other = train.node[(i + 2) % 3];
        if (held.find(one) != held.find(other) || held.find(last) == held.find(one)) continue;
        if (held.find(one) != held.find(ground) && std::abs(sum) > numerics::equal_given_values * size) continue;
        held.join(last, one);
        again = true;
      }
    }
  }
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
    const bool within = selection.modes->slider[k] == Modes::stuck && bounds.low < 0 && bounds.high > 0;
    if (direction != 0 && (within || (direction == -came_to_rest_[k] && !prescribed(network_.sliders[k].branch)))) return true;
  }
  return false;
}

void EventTransition::add_nodes(ModeSelection& selection, const State& state) const {
  for (std::size_t n = 0; n < structure_.kind.size(); ++n) {
    const int node = slot(static_cast<NodeId>(n));
    selection.problem.start(node, state.velocity[n]);
    if (structure_.kind[n] == Kind::massive) {
      selection.problem.set_inertia(node, structure_.mass[n] / selection.h);
      selection.slope_around[n] = structure_.inertia[n] / selection.h;
    }
    const double out = std::abs(selection.now->sum[n]) - slack_[n];
    if (out > numerics::balance_roundoff * selection.now->magnitude[n] + selection.now->rounding[n]) selection.problem.load(node, -std::copysign(out, selection.now->sum[n]));
  }
  selection.problem.fix(slot(ground), 0);
}

/// Adds the changes of the motions and the loads.
void EventTransition::add_inputs(ModeSelection& selection) {
  const double h = selection.h;
  const std::vector<double> load = inputs_.force, load_rate = inputs_.force_rate;
  inputs_.evaluate(selection.t + h);
  for (std::size_t m = 0; m < network_.motions.size(); ++m) {
    // Not a difference of two close velocities, which is round-off. The acceleration is the one at the end of h, like all else
    // here: its change may be all that changes the force of a sticking slider.
    selection.problem.fix(slot(network_.motions[m].node), h * inputs_.acceleration[m]);
  }
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const double change_of_load = std::abs(load_rate[k] * h) > 0 && std::abs(load_rate[k] * h) < numerics::load_difference * std::abs(load[k])
                                      ? load_rate[k] * h
                                      : inputs_.force[k] - load[k];
    selection.problem.load(slot(network_.forces[k].a), change_of_load);
    if (network_.forces[k].b >= 0) selection.problem.load(slot(network_.forces[k].b), -change_of_load);
  }
  for (std::size_t k = 0; k < network_.trains.size(); ++k) selection.loss.push_back(inputs_.loss(k));
  inputs_.evaluate(selection.t);
}

void EventTransition::add_deflection_laws(ModeSelection& selection, const State& state) const {
  const double h = selection.h;
  std::vector<double> f(state.p.size());
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->evaluate(&state.p[k], &f[k], &selection.creep[k]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->delay(i) > 0) continue;  // a load: see below
      const Branch& b = network_.deflections[k + i];
      const int branch = static_cast<int>(k + i);
      const double p = state.p[k + i], creep = selection.creep[k + i];
      double forward = h * laws.batch->slope(i, p, 1);
      double backward = h * laws.batch->slope(i, p, -1);
      // The event decides the direction of a branch that starts from rest or has passed through rest, not this first-order
      // problem: both sides get the slope of that direction.
      if (contains(selection.fired->starts, branch) || reversed(*selection.fired, branch)) {
        (laws.batch->direction(i) > 0 ? backward : forward) = laws.batch->direction(i) > 0 ? forward : backward;
      }
      selection.at_rest[k + i] = -h * laws.batch->slope(i, p, 0) * creep;
      selection.meet(structure_, b, std::max(forward, backward));
      double high = -forward * creep, low = std::min(high, -backward * creep);
      // A branch that has stopped does not go on in its old direction: again the event decides.
      if (contains(selection.fired->turns, branch) && may_stand(branch)) {
        (laws.batch->direction(i) > 0 ? low : high) = -laws.batch->direction(i) * std::numeric_limits<double>::infinity();
      }
      ConvexNetwork::Law law{.low = low, .high = high, .backward = backward, .forward = forward};
      if (const double slope = h * laws.batch->release_slope(i, p); slope > 0) law = released(law, slope, creep);
      selection.law[k + i] = selection.problem.add(slot(b.a), slot(b.b), law);
    }
  }
  // A delayed branch is a load: its change follows from the past, whatever moves now.
  for (std::size_t d = 0; d < inputs_.felt.size(); ++d) {
    const DelayHistory::Delayed& delayed = inputs_.history().delayed()[d];
    const double df = h * delayed_slope(delayed.branch, state) * (inputs_.felt[d] - selection.creep[at(delayed.branch)]);
    selection.problem.load(slot(delayed.a), -df);
    selection.problem.load(slot(delayed.b), df);
  }
}

void EventTransition::add_rate_laws(ModeSelection& selection, const State& state) const {
  const double largest = *std::max_element(selection.now->magnitude.begin(), selection.now->magnitude.end());
  const Inputs::Reach reach = coming_reach(inputs_, state.velocity);
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double impulse = laws.batch->impulse(i);
      if (impulse > 0 && std::isfinite(impulse)) selection.meet(structure_, network_.rates[at(laws.first) + i], impulse);
    }
  }
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      const double around = std::max(selection.slope_around[at(b.a)], selection.slope_around[at(b.b)]);
      const double w = state.velocity[at(b.a)] - state.velocity[at(b.b)];
      const double scale = largest > 0 ? largest : coming_force(*laws.batch, i, reach), least_force = numerics::rigid_force_share * scale;
      const double steepest = around > 0 ? std::max(numerics::rigid_slope_ratio * around, least_force / laws.batch->velocity_at(i, least_force))
                                         : std::numeric_limits<double>::infinity();
      selection.problem.add(slot(b.a), slot(b.b), law_of(*laws.batch, i, w, scale, steepest));
    }
  }
}

void EventTransition::add_sliders(ModeSelection& selection) const {
  for (std::size_t k = 0; k < selection.slider.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    const double force = (*selection.force)[k];
    const int train = network_.sliders[k].train;
    if (train >= 0 && selection.train_force.empty()) {
      constexpr double unlimited = std::numeric_limits<double>::infinity();
      selection.slider[k] = selection.problem.add(slot(b.a), slot(b.b), {.low = -unlimited, .high = unlimited});
      continue;
    }
    const auto change = [&](int side) {
      return train < 0 ? selection.h * bound_rate(k, side) : selection.loss[at(train)].lost(side, selection.train_force[at(train)]) - bound(k, side);
    };
    const double forward = change(1), backward = change(-1);
    ConvexNetwork::Law law{.low = -bound(k, -1) - force - backward, .high = bound(k, 1) - force + forward};
    // At its bound the rate alone decides, not the round-off of the event.
    const int side = bound(k, 1) - force < bound(k, -1) + force ? 1 : -1;
    const double limit = bound(k, side);
    const bool at_bound = std::isfinite(limit) && std::abs(std::abs(force) - limit) <= numerics::balance_roundoff * limit;
    const bool fired = contains(selection.fired->sliders, static_cast<int>(k));
    if (selection.modes->slider[k] == Modes::stuck && (at_bound || (fired && !stepped_))) {
      (side > 0 ? law.high : law.low) = side > 0 ? forward : -backward;
    } else if (came_to_rest_[k] != 0 && (massless(b.a) || massless(b.b))) {
      // How the velocity of a massless node continues, this first-order problem does not see: the event decides.
      (came_to_rest_[k] > 0 ? law.high : law.low) = came_to_rest_[k] * std::numeric_limits<double>::infinity();
    }
    selection.slider[k] = selection.problem.add(slot(b.a), slot(b.b), law);
    if (!fired) selection.problem.was_apart(selection.slider[k], selection.modes->slider[k]);
    selection.bound_side[k] = came_to_rest_[k] != 0 ? came_to_rest_[k] : law.high == forward ? 1 : law.low == -backward ? -1 : 0;
  }
}

/// An inerter resists a change of its velocity as a dashpot does a velocity.
void EventTransition::add_inerters(ModeSelection& selection) const {
  for (const Network::Inerter& inerter : network_.inerters) {
    const double slope = inerter.inertance / selection.h;
    selection.problem.add(slot(inerter.branch.a), slot(inerter.branch.b), {.backward = slope, .forward = slope, .of_change = true});
  }
}

void EventTransition::add_trains(ConvexNetwork& problem, const std::vector<double>& given) const {
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    const Network::Train& train = network_.trains[k];
    problem.tie({slot(train.node[0]), slot(train.node[1]), slot(train.node[2])}, train.factor, given[k]);
  }
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
