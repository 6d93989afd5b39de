#include "core/dae/mode_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/parallel_friction.hpp"
#include "core/dae/torn_links.hpp"
#include "core/dae/train_force_trials.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

namespace {

/// For each set, at the index of the node that represents it: a known node of the set, or -1.
std::vector<NodeId> given_in(const Structure& structure, DisjointSets& sets) {
  std::vector<NodeId> result(structure.kind.size(), -1);
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (structure.kind[n] == Kind::known) result[at(sets.find(static_cast<NodeId>(n)))] = static_cast<NodeId>(n);
  }
  return result;
}

/// Whether friction at its bound, where its slope is 0, is about to leave the bound in its present direction. It could stay,
/// but the least disturbance would end that. In parallel with a sticking slider it rests instead.
bool relaxes_from_bound(const ConvexNetwork& problem, int branch, const DeflectionBatch& batch, std::size_t i, double p) {
  const int direction = batch.direction(i);
  if (direction == 0 || !(batch.slope(i, p, direction) <= numerics::flat_slope * batch.slope(i, p, -direction))) return false;
  const auto [low, high] = problem.bounds(branch);
  return std::abs(problem.force(branch) - (direction > 0 ? high : low)) <= numerics::flat_slope * (high - low);
}

void take_directions(const LookAhead& ahead, const EventState& event, EventChange& change) {
  const EventNetwork& net = event.net;
  const Network& network = net.network;
  const ConvexNetwork& problem = ahead.problem();
  DisjointSets stuck(net.structure.kind.size());
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Branch& b = network.sliders[k].branch;
    if (ahead.holds(k)) stuck.join(b.a, b.b);
  }
  const std::vector<NodeId> given = given_in(net.structure, stuck);
  // By sticking sliders, or by known nodes of equal velocity.
  const auto kept_together = [&](const Branch& b) {
    const NodeId a = stuck.find(b.a), c = stuck.find(b.b), of_a = given[at(a)], of_b = given[at(c)];
    return a == c || (of_a >= 0 && of_b >= 0 && ahead.same_velocity(of_a, of_b));
  };
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const int j = laws.first + static_cast<int>(i);
      if (ahead.law(j) < 0 || laws.batch->events(i) == 0 || contains(event.fired.starts, j) || ahead.reversed(j)) continue;
      const Branch& b = network.deflections[at(j)];
      const double w = problem.difference(net.slot(b.a), net.slot(b.b));
      // Where a law can be held at rest the balance has decided, and the smallest velocity counts: a pseudoplastic dashpot in
      // parallel has a force at it.
      const auto [low, high] = problem.bounds(ahead.law(j));
      const bool at_rest = low < high && net.may_stand(j)
                               ? problem.joined(net.slot(b.a), net.slot(b.b)) || kept_together(b)
                               : ahead.same_velocity(b.a, b.b);
      const int direction = at_rest ? 0 : problem.direction(ahead.law(j));
      if (direction == 0) {
        if (net.may_stand(j) && !kept_together(b) &&
            relaxes_from_bound(problem, ahead.law(j), *laws.batch, i, event.state.p[at(j)])) {
          laws.batch->set_direction(i, event.state.p[at(j)], 0, laws.batch->direction(i));
        } else if (net.may_stand(j) && low < high) {
          change.sliding_modes.push_back({j, 0});
        } else if (!laws.batch->fits(i, 0)) {
          laws.batch->set_direction(i, event.state.p[at(j)], 0, 0);
        }
      } else if (!laws.batch->fits(i, w)) {
        laws.batch->set_direction(i, event.state.p[at(j)], w, direction);
      }
    }
  }
}

}  // namespace

std::vector<int> ModeSelection::select(const Event& event, double h, State& state, Modes& modes, const std::vector<double>& force, EventChange& change) {
  net_.inputs.sense(event.t, state);
  follow_motions(state);
  const NodalForces nodal = nodal_forces(net_, state, force, true);
  errors_.stop_at_turns(event.fired, modes, state);
  const EventState before{net_, bounds_, event.t, event.stepped, event.fired, state, modes, force, nodal, errors_.accepted()};
  const LookAhead ahead = with_onsets(before, h);
  refuse_blocked_motions(net_, event.t, ahead.problem());
  for (std::size_t n = 0; n < state.velocity.size(); ++n) {
    if (net_.structure.kind[n] != Kind::massive) state.velocity[n] = ahead.problem().value(net_.slot(static_cast<NodeId>(n)));
  }
  take_directions(ahead, before, change);
  std::vector<int> broken = set_sliders(ahead, before, modes, change);
  rest_beside_sliders(before);
  for (std::size_t k = 0; k < net_.network.trains.size(); ++k) {
    const Network::Train& train = net_.network.trains[k];
    if (train.loss) modes.b_drives[k] = ahead.b_drives(k, modes.slider[at(train.friction)]);
  }
  return broken;
}

/// Gives prescribed nodes their velocities after the event.
void ModeSelection::follow_motions(State& state) const {
  for (std::size_t m = 0; m < net_.network.motions.size(); ++m) {
    double& velocity = state.velocity[at(net_.network.motions[m].node)];
    const double before = std::exchange(velocity, net_.inputs.velocity[m]);
    // Two pieces of a signal meet to an ulp: what sticks to the motion follows, or it would slip by that ulp.
    if (std::abs(velocity - before) <= numerics::equal_velocities * std::abs(before)) std::replace(state.velocity.begin(), state.velocity.end(), before, double(velocity));
  }
}

/// Shortens the time h where a slider breaks away, or comes to rest, only later within it.
LookAhead ModeSelection::with_onsets(const EventState& event, double h) const {
  LookAhead ahead = with_accelerations(event, h);
  const double least = std::max(time_roundoff(event.t), numerics::present_step * h);
  if (ahead.breaks_loose() && h > least && !with_accelerations(event, least).breaks_loose()) {
    while (ahead.breaks_loose()) ahead = with_accelerations(event, h = std::max(least, numerics::onset_step_ratio * h));
  }
  // Not much shorter: round-off of the dashpots' forces would hide the changes of the springs' forces.
  const double shortest = std::max(least, numerics::onset_step_ratio * numerics::onset_step_ratio * h);
  while (ahead.stops_within() && h > shortest) ahead = with_accelerations(event, h = std::max(shortest, numerics::onset_step_ratio * h));
  return ahead;
}

/// Forces and bounds that blocks compute from velocities change with the accelerations. A first solution gives these.
LookAhead ModeSelection::with_accelerations(const EventState& event, double h) const {
  LookAhead first = look_ahead(event, h);
  if (!net_.inputs.blocks().senses_velocities()) return first;
  std::vector<double> acceleration(net_.structure.kind.size(), 0);
  for (std::size_t n = 0; n < acceleration.size(); ++n) {
    if (net_.structure.kind[n] == Kind::massive) acceleration[n] = first.problem().change(net_.slot(static_cast<NodeId>(n))) / h;
  }
  net_.inputs.accelerate(acceleration);
  net_.inputs.evaluate(event.t);
  return look_ahead(event, h);
}

/// Tries forces of trains until the bounds of their losses, which depend on them, lead to the same forces.
LookAhead ModeSelection::look_ahead(const EventState& event, double h) const {
  const std::vector<double>& before = event.state.train_force;
  double forces = 0;
  for (const Network::Train& train : net_.network.trains) {
    for (const NodeId node : train.node) forces = std::max(forces, event.nodal.magnitude[at(node)]);
  }
  const auto follow = [&](TrainForceTrials trials) -> std::optional<LookAhead> {
    while (!trials.endless()) {
      LookAhead ahead(event, h, trials.trial());
      if (trials.agree(ahead.train_force(), ahead.problem().largest_force())) return ahead;
    }
    return {};
  };
  if (auto found = follow({net_.network, net_.inputs, before, forces})) return *std::move(found);
  // Trials that lead nowhere begin anew where all gears with losses stand still: self-locking may hold them.
  if (auto found = follow({net_.network, net_.inputs, LookAhead(event, h, {}).train_force(), forces})) return *std::move(found);
  for (TrainForceTrials& trials : TrainForceTrials::around(net_.network, net_.inputs, forces)) {
    if (auto found = follow(std::move(trials))) return *std::move(found);
  }
  report_losses(net_.network, at_time(*net_.network.scene, event.t));
}

/// Sets the modes of the sliders. Returns those that break away under a force above their sliding force.
std::vector<int> ModeSelection::set_sliders(const LookAhead& ahead, const EventState& event, Modes& modes, EventChange& change) const {
  const std::size_t nodes = net_.structure.kind.size();
  const ConvexNetwork& problem = ahead.problem();
  std::vector<int> broken;
  DisjointSets given(nodes), held(nodes);  // of nodes; of their places in the problem
  ahead.join_given(given);
  for (std::size_t n = 0; n < nodes; ++n) held.join(net_.slot(static_cast<NodeId>(n)), net_.slot(given.find(static_cast<NodeId>(n))));
  for (std::size_t k = 0; k < modes.slider.size(); ++k) {
    const Branch& b = net_.network.sliders[k].branch;
    if (ahead.holds(k)) held.join(net_.slot(b.a), net_.slot(b.b));
  }
  problem.join_by_equations(held);
  const auto set = [&](std::size_t k, int direction) {
    modes.slider[k] = static_cast<signed char>(direction);
    if (direction != 0 && bounds_.bound(k, direction) > bounds_.sliding(k, direction)) broken.push_back(static_cast<int>(k));
  };
  for (std::size_t k = 0; k < modes.slider.size(); ++k) {
    const int a = net_.slot(net_.network.sliders[k].branch.a), b = net_.slot(net_.network.sliders[k].branch.b);
    // A slider at its bound, while others hold its ends, sticks: the forces of all of them are those of least norm.
    const bool sticks = held.find(a) == held.find(b) && problem.difference(a, b) == 0 && !bounds_.broken(k);
    set(k, apart(net_.network, net_.network.sliders[k]) ? Modes::forward : sticks ? 0 : problem.direction(ahead.slider(k)));
  }
  for (const int k : let_slip(ahead, event, modes, change)) set(at(k), modes.slider[at(k)]);
  return broken;
}

}  // namespace rheonet
