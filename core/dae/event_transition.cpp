#include "core/dae/event_transition.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"

namespace rheonet {

namespace {

/// Steps that arrive through delays change the deflections of delayed branches at once. Nothing moves at their ends then: the
/// energy that they store thereby is deducted from the heat that was counted at the step itself (see QuasistaticJumps).
bool take_delayed_steps(const EventNetwork& net, double t, State& state, EventChange& change) {
  DelayHistory& history = net.inputs.history();
  bool any = false;
  for (std::size_t k = 0; k < history.delayed().size(); ++k) {
    const int branch = history.delayed()[k].branch;
    const double step = history.take_steps(k, t);
    if (step == 0) continue;
    std::size_t i = 0;
    DeflectionBatch& batch = net.network.batch_of(branch, i);
    double& p = state.p[at(branch)];
    change.heat += batch.stored_energy(i, p);
    batch.jump(i, p, step);
    p += step;
    change.heat -= batch.stored_energy(i, p);
    any = true;
  }
  return any;
}

/// Friction that reverses counts its deflection from there.
void count_from_turns(const Network& network, State& state) {
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      const double by = laws.batch->recentre(i, state.p[j]);
      state.p[j] -= by;
      state.offset[j] += by;
    }
  }
}

/// A time in which neither the inputs nor the network change course, but not below the resolution of time [s].
double look_ahead_time(const EventNetwork& net, double t, double horizon, const State& state) {
  const std::size_t nodes = net.structure.kind.size();
  std::vector<double> stiffness(nodes, 0), damping(nodes, 0);
  double fastest = 0;
  const auto add = [](std::vector<double>& sum, const Branch& b, double x) {
    sum[at(b.a)] += x;
    sum[at(b.b)] += x;
  };
  std::vector<double> f(state.p.size()), df(f), c(f), dc(f);
  for (const Laws<DeflectionBatch>& laws : net.network.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&state.p[k], &f[k], &df[k], &c[k], &dc[k]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double slope = std::max(laws.batch->slope(i, state.p[k + i], 1), laws.batch->slope(i, state.p[k + i], -1));
      add(stiffness, net.network.deflections[k + i], slope);
      if (laws.batch->creeps(i) && df[k + i] != 0) fastest = std::max(fastest, slope * std::abs(dc[k + i] / df[k + i]));
    }
  }
  for (const Laws<RateBatch>& laws : net.network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = net.network.rates[at(laws.first) + i];
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
    const double m = net.structure.inertia[n];
    if (net.structure.kind[n] == Kind::known) continue;
    if (m > 0) fastest = std::max({fastest, damping[n] / m, std::sqrt(stiffness[n] / m)});
    if (m == 0 && damping[n] > 0) fastest = std::max(fastest, stiffness[n] / damping[n]);
  }
  double ahead = numerics::horizon_step * horizon;
  // In a shorter time the round-off of the dashpots' forces would hide the changes of the springs' forces.
  if (fastest > 0) ahead = std::clamp(ahead, numerics::least_network_step / fastest, numerics::largest_network_step / fastest);
  return std::max(std::min(ahead, net.inputs.history().shortest() / 2), time_roundoff(t));
}

}  // namespace

EventTransition::EventTransition(const Network& network, const Structure& classified, Inputs& inputs)
    : net_(network, classified, inputs),
      bounds_(network, inputs),
      errors_(net_, bounds_),
      steps_(net_),
      impacts_(net_),
      jumps_(net_, bounds_, errors_),
      selection_(net_, bounds_, errors_) {}

EventChange EventTransition::cross(double t, double horizon, bool stepped, const FiredGuards& fired, State& state, Modes& modes,
                                   std::vector<double>& force) {
  EventChange change;
  Inputs& inputs = net_.inputs;
  inputs.transmit(state.train_force);
  inputs.sense(t, state);
  PositionSteps::Steps steps = steps_.at_event(t, stepped, state, change.notes);
  const bool driven = std::any_of(steps.dx.begin(), steps.dx.end(), [](double d) { return d != 0; });
  const bool delayed = take_delayed_steps(net_, t, state, change);
  // A brake that closes finds its ends at rest if they move more slowly than is resolved: no error of steps makes it slip.
  FiredGuards stopped = fired;
  for (const int k : fired.within_band) {
    if (bounds_.sliding(at(k), modes.slider[at(k)]) > 0) stopped.sliders.push_back(k);
  }
  impacts_.resolve(t, steps.momentum, stopped, modes, state, change);
  bounds_.begin(stopped, modes, stepped);
  errors_.begin();
  // Between steps of the inputs, any imbalance before something breaks away is an error of the integrator's steps.
  bool smooth = !stepped && !delayed;
  if (smooth) errors_.take_back_excess(modes, force);
  // A step that arrives through a delay is no step of the inputs: these do no work then.
  bool works = stepped && (driven || !delayed);
  const FiredGuards none;
  const auto& sliders = net_.network.sliders;
  const auto contacts = std::count_if(sliders.begin(), sliders.end(), [](const Network::Slider& s) { return s.contact.has_value(); });
  // A slider that breaks away above its sliding force releases the difference: others may follow.
  for (bool again = true; again;) {
    // A large displacement leaves its own round-off: a second jump removes it.
    inputs.sense(t, state);
    for (int k = 0; smooth && k < numerics::jumps_in_a_row && jumps_.settle_errors(t, state, force); ++k) inputs.sense(t, state);
    for (int k = 0; k < numerics::jumps_in_a_row + contacts; ++k) {
      const std::optional<double> heat = jumps_.jump(t, works, steps.dx, state, force);
      if (!heat) break;
      change.heat += *heat;
      inputs.sense(t, state);
    }
    if (smooth) errors_.keep_slipping(force);
    smooth = false;
    change.sliding_modes.clear();  // these were held before the last break-away
    const double h = look_ahead_time(net_, t, horizon, state);
    again = false;
    for (const int k : selection_.select({t, stepped, works ? none : fired}, h, state, modes, force, change)) {
      again = again || !bounds_.broken(at(k));  // each once, so this ends
      bounds_.break_away(at(k));
    }
    works = false;
  }
  count_from_turns(net_.network, state);
  impacts_.open_contacts(modes, state, change);
  return change;
}

void EventTransition::check_load(double t, double then, const State& state, const std::vector<double>& slider_force) const {
  net_.inputs.sense(t, state);
  net_.inputs.evaluate(then);
  jumps_.refuse_overload(t, state, slider_force);
}

}  // namespace rheonet
