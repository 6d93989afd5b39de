#include "core/dae/event_transition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/dae/dae.hpp"
#include "core/network/rigid_links.hpp"

namespace rheonet {

EventTransition::EventTransition(const Network& network, const Structure& classified, Inputs& inputs)
    : network_(network),
      structure_(classified),
      inputs_(inputs),
      broken_(network.sliders.size(), 0),
      impulse_told_(network.scene->elements.size(), 0),
      slipping_(network.sliders.size(), 0),
      came_to_rest_(network.sliders.size(), Modes::stuck),
      slack_(classified.kind.size(), 0),
      firm_(firm_nodes(network, classified)) {
  std::vector<char> known;
  for (const Kind kind : classified.kind) known.push_back(kind == Kind::known);
  led_by_ = linked_to(network, known);
}

// A slider that slips must come to rest, and break away, before it slips the other way.
double EventTransition::bound(std::size_t k, int side) const {
  const Bounds& bounds = inputs_.box(k).at(side);
  return broken_[k] || slipping_[k] == side ? bounds.sliding.value : bounds.breakaway.value;
}

double EventTransition::bound_rate(std::size_t k, int side) const {
  if (network_.sliders[k].varying.empty()) return 0;
  const Bounds& bounds = inputs_.box(k).at(side);
  return broken_[k] || slipping_[k] == side ? bounds.sliding.derivative : bounds.breakaway.derivative;
}

EventTransition::Change EventTransition::cross(double t, double horizon, bool stepped, const Fired& fired, State& state,
                               Modes& modes, std::vector<double>& force) {
  Change change;
  inputs_.transmit(state.train_force);
  inputs_.sense(t, state);
  stepped_ = stepped;
  std::vector<double> dx(structure_.kind.size(), 0);
  std::vector<double> momentum(dx);
  if (stepped) position_steps(t, dx, momentum, state, change.notes);
  const bool driven = std::any_of(dx.begin(), dx.end(), [](double d) { return d != 0; });
  // A step that arrives through a delay is no step of the inputs: these do no work then.
  const bool delayed = take_delayed_steps(t, state, change);
  if (delayed && !driven) stepped = false;
  // At the start, nodes that rigid links join need not have one velocity.
  if (!started_) change.heat += halt(t, {}, modes, state, change.notes);
  change.heat += collide(t, momentum, fired.settles, state, change);
  change.heat += halt(t, fired.sliders, modes, state, change.notes);
  for (std::size_t k = 0; k < broken_.size(); ++k) {
    const bool event = contains(fired.sliders, static_cast<int>(k));
    broken_[k] = 0;
    came_to_rest_[k] = Modes::stuck;
    if (event && !stepped_) came_to_rest_[k] = modes.slider[k];
    slipping_[k] = event || network_.sliders[k].contact ? 0 : modes.slider[k];
  }
  // Between steps of the inputs, any imbalance before something breaks away is an error of the integrator's steps.
  bool smooth = !stepped_ && !delayed;
  std::fill(slack_.begin(), slack_.end(), 0.0);
  if (smooth) take_back_excess(modes, force);
  // A slider that breaks away above its sliding force releases the difference: others may follow.
  for (bool again = true; again;) {
    // A large displacement leaves its own round-off: a second jump removes it.
    inputs_.sense(t, state);
    for (int k = 0; smooth && k < numerics::jumps_in_a_row && settle_errors(t, state, force); ++k) inputs_.sense(t, state);
    for (int k = 0; k < numerics::jumps_in_a_row + contacts() && jump(t, stepped, dx, state, force, change); ++k) inputs_.sense(t, state);
    if (smooth) keep_slipping(force);
    smooth = false;
    change.sliding_modes.clear();  // these were held before the last break-away
    again = false;
    for (const int k : select_modes(t, time_ahead(t, horizon, state), stepped ? Fired{} : fired, state, modes, force, change)) {
      again = again || !broken_[at(k)];  // each once, so this ends
      broken_[at(k)] = 1;
    }
    stepped = false;
  }
  count_from_turns(state);
  open_contacts(modes, state, change);
  return change;
}

/// Friction that reverses counts its deflection from there.
void EventTransition::count_from_turns(State& state) const {
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double by = laws.batch->recentre(i, state.p[j]);
      state.p[j] -= by;
      state.offset[j] += by;
    }
  }
}

/// Between steps of the inputs, a slider's force beyond its bound is an error of the integrator's steps. The force is set to
/// the bound, and the imbalance at its nodes is accepted: nothing need jump for it.
void EventTransition::take_back_excess(const Modes& modes, std::vector<double>& force) {
  for (std::size_t k = 0; k < force.size(); ++k) {
    const int side = force[k] > 0 ? 1 : -1;
    const double most = bound(k, side), excess = std::abs(force[k]) - most;
    if (modes.slider[k] != Modes::stuck || !(excess > 0)) continue;
    force[k] = side * most;
    for (const NodeId node : {network_.sliders[k].branch.a, network_.sliders[k].branch.b}) slack_[at(node)] += excess;
  }
}

/// Integration error alone does not stop a slipping slider: keep its force and accept the residual at its nodes.
void EventTransition::keep_slipping(std::vector<double>& force) {
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double full = slipping_[k] * inputs_.box(k).at(slipping_[k]).sliding.value, lack = slipping_[k] * (full - force[k]);
    if (!(lack > 0) || lack > numerics::step_error_of_balance * std::abs(full)) continue;
    force[k] = full;
    for (const NodeId node : {network_.sliders[k].branch.a, network_.sliders[k].branch.b}) slack_[at(node)] += lack;
  }
}

/// Steps that arrive through delays change the deflections of delayed branches at once. Nothing moves at their ends then: the
/// energy that they store thereby is deducted from the heat that was counted at the step itself (see jump).
bool EventTransition::take_delayed_steps(double t, State& state, Change& change) {
  DelayHistory& history = inputs_.history();
  bool any = false;
  for (std::size_t k = 0; k < history.delayed().size(); ++k) {
    const int branch = history.delayed()[k].branch;
    const double step = history.take_steps(k, t);
    if (step == 0) continue;
    std::size_t i = 0;
    DeflectionBatch& batch = network_.batch_of(branch, i);
    double& p = state.p[at(branch)];
    change.heat += batch.stored_energy(i, p);
    batch.jump(i, p, step);
    p += step;
    change.heat -= batch.stored_energy(i, p);
    any = true;
  }
  return any;
}

void EventTransition::check_load(double t, double then, const State& state, const std::vector<double>& slider_force) const {
  inputs_.sense(t, state);
  inputs_.evaluate(then);
  const std::optional<Jump> jump = find_jump(std::vector<double>(structure_.kind.size(), 0), state, slider_force);
  if (jump && jump->outcome == ConvexNetwork::Outcome::unbounded) report_runaway(t, jump->problem.runaways(), state);
}

/// A time in which neither the inputs nor the network change course, but not below the resolution of time [s].
double EventTransition::time_ahead(double t, double horizon, const State& state) const {
  const std::size_t nodes = structure_.kind.size();
  std::vector<double> stiffness(nodes, 0), damping(nodes, 0);
  double fastest = 0;
  const auto add = [](std::vector<double>& sum, const Branch& b, double x) {
    sum[at(b.a)] += x;
    sum[at(b.b)] += x;
  };
  std::vector<double> f(state.p.size()), df(f), c(f), dc(f);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&state.p[k], &f[k], &df[k], &c[k], &dc[k]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double slope = std::max(laws.batch->slope(i, state.p[k + i], 1), laws.batch->slope(i, state.p[k + i], -1));
      add(stiffness, network_.deflections[k + i], slope);
      if (laws.batch->creeps(i) && df[k + i] != 0) fastest = std::max(fastest, slope * std::abs(dc[k + i] / df[k + i]));
    }
  }
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      const double w = state.velocity[at(b.a)] - state.velocity[at(b.b)];
      const double impulse = laws.batch->impulse(i);
      if (impulse > 0 && std::isfinite(impulse)) {
        add(damping, b, impulse);
      } else if (w != 0) {
        add(damping, b, laws.batch->force_at(i, w) / w);
      }
    }
  }
  for (std::size_t n = 1; n < nodes; ++n) {
    const double m = structure_.inertia[n];
    if (structure_.kind[n] == Kind::known) continue;
    if (m > 0) fastest = std::max({fastest, damping[n] / m, std::sqrt(stiffness[n] / m)});
    if (m == 0 && damping[n] > 0) fastest = std::max(fastest, stiffness[n] / damping[n]);
  }
  double ahead = numerics::horizon_step * horizon;
  // In a shorter time the round-off of the dashpots' forces would hide the changes of the springs' forces.
  if (fastest > 0) ahead = std::clamp(ahead, numerics::least_network_step / fastest, numerics::largest_network_step / fastest);
  return std::max(std::min(ahead, inputs_.history().shortest() / 2), time_roundoff(t));
}

double EventTransition::given_velocity(NodeId node) const {
  return structure_.motion[at(node)] < 0 ? 0 : inputs_.velocity[at(structure_.motion[at(node)])];
}

double EventTransition::force_of_deflection(const DeflectionBatch& batch, std::size_t i, double p) {
  return p == 0 ? 0 : batch.slope(i, p, batch.direction(i)) * std::abs(p);
}

EventTransition::Nodal EventTransition::nodal(const State& state, const std::vector<double>& slider_force, bool rates) const {
  const std::vector<double> none(structure_.kind.size(), 0);
  Nodal result{none, none, none};
  const auto add = [&](NodeId node, double f) {
    if (node < 0) return;
    result.sum[at(node)] += f;
    result.magnitude[at(node)] += std::abs(f);
  };
  const auto add_branch = [&](const Branch& b, double f) {
    add(b.a, f);
    add(b.b, -f);
  };
  std::vector<double> f(state.p.size()), c(f);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &c[at(laws.first)]);
  }
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const Branch& b = network_.deflections[j];
      add_branch(b, f[j]);
      const double more = numerics::deflection_force_share * force_of_deflection(*laws.batch, i, state.p[j]) - std::abs(f[j]);
      for (const NodeId node : {b.a, b.b}) result.magnitude[at(node)] += std::max(0.0, more);
    }
  }
  for (std::size_t k = 0; k < slider_force.size(); ++k) add_branch(network_.sliders[k].branch, slider_force[k]);
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; rates && i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      const double va = state.velocity[at(b.a)], vb = state.velocity[at(b.b)], w = va - vb;
      const double force = laws.batch->force_at(i, w);
      add_branch(b, force);
      if (!(laws.batch->growth(i).exponent < 1)) continue;
      // This law is solved for its force, to the round-off of velocities: near rest that round-off changes the force.
      const double left = numerics::equation_roundoff * (std::abs(va) + std::abs(vb));
      const double rounding = std::max(laws.batch->force_at(i, w + left) - force, force - laws.batch->force_at(i, w - left));
      for (const NodeId node : {b.a, b.b}) result.rounding[at(node)] += rounding;
    }
  }
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) add(network_.trains[k].node[i], network_.trains[k].factor[i] * state.train_force[k]);
  }
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    add(network_.forces[k].a, -inputs_.force[k]);
    add(network_.forces[k].b, inputs_.force[k]);
  }
  return result;
}

/// A branch that has stopped has no velocity: the dead band of its guard leaves one, which may outweigh all changes within the
/// look-ahead time. Nodes that stick to its massless end, or are held there, stop with it.
void EventTransition::stop_at_turns(const Fired& fired, const Modes& modes, State& state) {
  if (std::none_of(fired.turns.begin(), fired.turns.end(), [&](int j) { return may_stand(j); })) return;
  DisjointSets together(structure_.kind.size());
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    const Branch& b = network_.sliders[k].branch;
    if (modes.slider[k] == Modes::stuck) together.join(b.a, b.b);
  }
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.deflections[at(laws.first) + i];
      if (laws.batch->holds(i)) together.join(b.a, b.b);
    }
  }
  std::vector<char> heavy(structure_.kind.size(), 0);
  for (std::size_t n = 0; n < heavy.size(); ++n) {
    if (!massless(static_cast<NodeId>(n))) heavy[at(together.find(static_cast<NodeId>(n)))] = 1;
  }
  const std::vector<double> before = state.velocity;
  for (const int j : fired.turns) {
    if (!may_stand(j)) continue;
    const Branch& b = network_.deflections[at(j)];
    NodeId stops = together.find(b.a), beside = b.b;
    if (heavy[at(stops)]) std::tie(stops, beside) = std::pair(together.find(b.b), b.a);
    if (heavy[at(stops)] || together.find(beside) == stops) continue;
    const double velocity = state.velocity[at(beside)];
    for (std::size_t n = 0; n < heavy.size(); ++n) {
      if (together.find(static_cast<NodeId>(n)) == stops) state.velocity[n] = velocity;
    }
  }
  // The balances lack the forces of that velocity (large for a pseudoplastic dashpot): accept the imbalance.
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network_.rates[at(laws.first) + i];
      const double w = before[at(b.a)] - before[at(b.b)], now = state.velocity[at(b.a)] - state.velocity[at(b.b)];
      if (now == w) continue;
      const double left = std::abs(laws.batch->force_at(i, w) - laws.batch->force_at(i, now));
      for (const NodeId node : {b.a, b.b}) slack_[at(node)] += left;
    }
  }
}

}  // namespace rheonet
