#include "core/dae/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/contacts.hpp"
#include "core/dae/overload.hpp"
#include "core/dae/rate_law.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

namespace {

double delayed_slope(const Network& network, int branch, const State& state) {
  std::size_t i = 0;
  return network.batch_of(branch, i).slope(i, state.p[at(branch)], 0);
}

/// Friction at its bound: it leaves the bound with this slope at velocities below its creep, and keeps its force above.
ConvexNetwork::Law released(ConvexNetwork::Law law, double slope, double creep) {
  const double side = creep > 0 ? 1 : -1;
  (side > 0 ? law.high : law.low) = -slope * creep;
  (side > 0 ? law.forward : law.backward) = slope;
  const ConvexNetwork::Law other = law;
  law.beyond = [=](double w, double& tangent) {
    if (w * side < 0) {
      tangent = side > 0 ? other.backward : other.forward;
      return (side > 0 ? other.low : other.high) + tangent * w;
    }
    tangent = std::abs(w) < std::abs(creep) ? slope : 0;
    return side * slope * std::min(0.0, std::abs(w) - std::abs(creep));
  };
  return law;
}

/// Change of the force of a rate law when the velocity changes from w0. A law without a finite slope there gets one that leads
/// away, towards forces of about `scale` [N]. Slopes above `steepest` [N s/m] are treated as rigid, and replaced by it.
ConvexNetwork::Law law_of_change(const RateBatch& batch, std::size_t i, double w0, double scale, double steepest) {
  const double impulse = batch.impulse(i);
  if (batch.linear(i)) return {.backward = impulse, .forward = impulse, .of_change = true};
  const Growth growth = batch.growth(i);
  const double rigid = growth.exponent < 1 ? std::pow(growth.coefficient / steepest, 1 / (1 - growth.exponent)) : 0;
  const auto force = [&batch, i, rigid, steepest](double w) {
    return std::abs(w) < rigid ? steepest * w : batch.force_at(i, w);
  };
  // The tangent of B |w|^n is n f/w, its secant f/w: the larger one never overshoots.
  const auto steeper = [force](double w, double f) { return f == 0 ? 0 : f / w * std::max(1.0, std::log2(force(2 * w) / f)); };
  const double f0 = force(w0), slope = w0 != 0 ? steeper(w0, f0) : std::min(steepest, scale / batch.velocity_at(i, scale));
  return {.backward = slope, .forward = slope, .rounding = std::abs(f0), .of_change = true,
          .beyond = [force, w0, f0, slope, steeper](double change, double& tangent) {
            const double w = w0 + change, f = force(w);
            tangent = w != 0 ? steeper(w, f) : slope;
            return f - f0;
          }};
}

}  // namespace

LookAhead::LookAhead(const EventState& event, double h, const std::vector<double>& train_force)
    : event_(&event),
      h_(h),
      problem_(static_cast<int>(event.state.velocity.size())),
      slope_around_(event.state.velocity.size(), 0),
      law_(event.state.p.size(), -1),
      creep_(event.state.p.size()),
      at_rest_(event.state.p.size()),
      slider_(event.force.size()),
      bound_side_(event.force.size()),
      train_force_(train_force) {
  const Network& network = event.net.network;
  add_nodes();
  add_inputs();
  add_deflection_laws();
  add_rate_laws();
  add_inerters();
  event.net.tie_trains(problem_, std::vector<double>(network.trains.size(), 0));
  add_sliders();
  if (const ConvexNetwork::Outcome outcome = problem_.solve(); outcome != ConvexNetwork::Outcome::solved) {
    if (outcome == ConvexNetwork::Outcome::unbounded) report_runaway(event.net, event.bounds, event.t, problem_.runaways(), event.state);
    report_undecided(network, at_time(*network.scene, event.t));
  }
  train_force_ = problem_.forces_of_equations();
  for (std::size_t k = 0; k < train_force_.size(); ++k) train_force_[k] += event.state.train_force[k];
}

void LookAhead::meet(const Branch& b, double slope) {
  for (const NodeId n : {b.a, b.b}) {
    if (event_->net.structure.kind[at(n)] != Kind::known) slope_around_[at(n)] = std::max(slope_around_[at(n)], slope);
  }
}

void LookAhead::add_nodes() {
  const EventNetwork& net = event_->net;
  for (std::size_t n = 0; n < net.structure.kind.size(); ++n) {
    const int node = net.slot(static_cast<NodeId>(n));
    problem_.start(node, event_->state.velocity[n]);
    if (net.structure.kind[n] == Kind::massive) {
      problem_.set_inertia(node, net.structure.mass[n] / h_);
      slope_around_[n] = net.structure.inertia[n] / h_;
    }
    if (const double lacking = event_->nodal.lacking(n, event_->accepted[n]); lacking != 0) problem_.load(node, lacking);
  }
  problem_.fix(net.slot(ground), 0);
}

/// Adds the changes of the motions and the loads.
void LookAhead::add_inputs() {
  const EventNetwork& net = event_->net;
  const std::vector<double> load = net.inputs.force, load_rate = net.inputs.force_rate;
  net.inputs.evaluate(event_->t + h_);
  for (std::size_t m = 0; m < net.network.motions.size(); ++m) {
    // Not a difference of two close velocities, which is round-off. The acceleration is the one at the end of h, like all else
    // here: its change may be all that changes the force of a sticking slider.
    problem_.fix(net.slot(net.network.motions[m].node), h_ * net.inputs.acceleration[m]);
  }
  for (std::size_t k = 0; k < net.network.forces.size(); ++k) {
    const double change_of_load = std::abs(load_rate[k] * h_) > 0 && std::abs(load_rate[k] * h_) < numerics::load_difference * std::abs(load[k])
                                      ? load_rate[k] * h_
                                      : net.inputs.force[k] - load[k];
    problem_.load(net.slot(net.network.forces[k].a), change_of_load);
    if (net.network.forces[k].b >= 0) problem_.load(net.slot(net.network.forces[k].b), -change_of_load);
  }
  for (std::size_t k = 0; k < net.network.trains.size(); ++k) loss_.push_back(net.inputs.loss(k));
  net.inputs.evaluate(event_->t);
}

void LookAhead::add_deflection_laws() {
  const EventNetwork& net = event_->net;
  std::vector<double> f(event_->state.p.size());
  for (const Laws<DeflectionBatch>& laws : net.network.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->evaluate(&event_->state.p[k], &f[k], &creep_[k]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->delay(i) > 0) continue;  // a load: see below
      const Branch& b = net.network.deflections[k + i];
      const int branch = static_cast<int>(k + i);
      const double p = event_->state.p[k + i], creep = creep_[k + i];
      double forward = h_ * laws.batch->slope(i, p, 1);
      double backward = h_ * laws.batch->slope(i, p, -1);
      // The event decides the direction of a branch that starts from rest or has passed through rest, not this first-order
      // problem: both sides get the slope of that direction.
      if (contains(event_->fired.starts, branch) || reversed(branch)) {
        (laws.batch->direction(i) > 0 ? backward : forward) = laws.batch->direction(i) > 0 ? forward : backward;
      }
      at_rest_[k + i] = -h_ * laws.batch->slope(i, p, 0) * creep;
      meet(b, std::max(forward, backward));
      double high = -forward * creep, low = std::min(high, -backward * creep);
      // A branch that has stopped does not go on in its old direction: again the event decides.
      if (contains(event_->fired.turns, branch) && net.may_stand(branch)) {
        (laws.batch->direction(i) > 0 ? low : high) = -laws.batch->direction(i) * std::numeric_limits<double>::infinity();
      }
      ConvexNetwork::Law law{.low = low, .high = high, .backward = backward, .forward = forward};
      if (const double slope = h_ * laws.batch->release_slope(i, p); slope > 0) law = released(law, slope, creep);
      law_[k + i] = problem_.add(net.slot(b.a), net.slot(b.b), law);
    }
  }
  // A delayed branch is a load: its change follows from the past, whatever moves now.
  for (std::size_t d = 0; d < net.inputs.felt.size(); ++d) {
    const DelayHistory::Delayed& delayed = net.inputs.history().delayed()[d];
    const double df = h_ * delayed_slope(net.network, delayed.branch, event_->state) * (net.inputs.felt[d] - creep_[at(delayed.branch)]);
    problem_.load(net.slot(delayed.a), -df);
    problem_.load(net.slot(delayed.b), df);
  }
}

void LookAhead::add_rate_laws() {
  const EventNetwork& net = event_->net;
  const double largest = *std::max_element(event_->nodal.magnitude.begin(), event_->nodal.magnitude.end());
  const Inputs::Reach reach = coming_reach(net.inputs, event_->state.velocity);
  for (const Laws<RateBatch>& laws : net.network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double impulse = laws.batch->impulse(i);
      if (impulse > 0 && std::isfinite(impulse)) meet(net.network.rates[at(laws.first) + i], impulse);
    }
  }
  for (const Laws<RateBatch>& laws : net.network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = net.network.rates[at(laws.first) + i];
      const double around = std::max(slope_around_[at(b.a)], slope_around_[at(b.b)]);
      const double w = event_->state.velocity[at(b.a)] - event_->state.velocity[at(b.b)];
      const double scale = largest > 0 ? largest : coming_force(*laws.batch, i, reach), least_force = numerics::rigid_force_share * scale;
      const double steepest = around > 0 ? std::max(numerics::rigid_slope_ratio * around, least_force / laws.batch->velocity_at(i, least_force))
                                         : std::numeric_limits<double>::infinity();
      problem_.add(net.slot(b.a), net.slot(b.b), law_of_change(*laws.batch, i, w, scale, steepest));
    }
  }
}

/// An inerter resists a change of its velocity as a dashpot does a velocity.
void LookAhead::add_inerters() {
  const EventNetwork& net = event_->net;
  for (const Network::Inerter& inerter : net.network.inerters) {
    const double slope = inerter.inertance / h_;
    problem_.add(net.slot(inerter.branch.a), net.slot(inerter.branch.b), {.backward = slope, .forward = slope, .of_change = true, .inertial = true});
  }
}

void LookAhead::add_sliders() {
  const EventNetwork& net = event_->net;
  for (std::size_t k = 0; k < slider_.size(); ++k) {
    const Branch& b = net.network.sliders[k].branch;
    const double force = event_->force[k];
    const int train = net.network.sliders[k].train;
    if (train >= 0 && train_force_.empty()) {
      constexpr double unlimited = std::numeric_limits<double>::infinity();
      slider_[k] = problem_.add(net.slot(b.a), net.slot(b.b), {.low = -unlimited, .high = unlimited});
      continue;
    }
    const auto change = [&](int side) {
      return train < 0 ? h_ * event_->bounds.rate(k, side) : loss_[at(train)].lost(side, train_force_[at(train)]) - event_->bounds.bound(k, side);
    };
    const double forward = change(1), backward = change(-1);
    ConvexNetwork::Law law{.low = -event_->bounds.bound(k, -1) - force - backward, .high = event_->bounds.bound(k, 1) - force + forward};
    // At its bound the rate alone decides, not the round-off of the event.
    const int side = event_->bounds.bound(k, 1) - force < event_->bounds.bound(k, -1) + force ? 1 : -1;
    const double limit = event_->bounds.bound(k, side);
    const bool at_bound = std::isfinite(limit) && std::abs(std::abs(force) - limit) <= numerics::balance_roundoff * limit;
    const bool fired = contains(event_->fired.sliders, static_cast<int>(k));
    if (event_->modes.slider[k] == Modes::stuck && (at_bound || (fired && !event_->stepped))) {
      (side > 0 ? law.high : law.low) = side > 0 ? forward : -backward;
    } else if (event_->bounds.came_to_rest(k) != 0 && (net.massless(b.a) || net.massless(b.b))) {
      // How the velocity of a massless node continues, this first-order problem does not see: the event decides.
      (event_->bounds.came_to_rest(k) > 0 ? law.high : law.low) = event_->bounds.came_to_rest(k) * std::numeric_limits<double>::infinity();
    }
    slider_[k] = problem_.add(net.slot(b.a), net.slot(b.b), law);
    if (!fired) problem_.was_apart(slider_[k], event_->modes.slider[k]);
    bound_side_[k] = event_->bounds.came_to_rest(k) != 0 ? event_->bounds.came_to_rest(k) : law.high == forward ? 1 : law.low == -backward ? -1 : 0;
  }
}

bool LookAhead::holds(std::size_t slider) const {
  const EventNetwork& net = event_->net;
  return problem_.direction(slider_[slider]) == 0 && !apart(net.network, net.network.sliders[slider]);
}

bool LookAhead::breaks_loose() const {
  const EventNetwork& net = event_->net;
  for (std::size_t k = 0; k < slider_.size(); ++k) {
    const ConvexNetwork::Bounds bounds = problem_.bounds(slider_[k]);
    const int direction = problem_.direction(slider_[k]);
    const bool within = event_->modes.slider[k] == Modes::stuck && bounds.low < 0 && bounds.high > 0 && !at_loss(k);
    if (direction != 0 && (within || (direction == -event_->bounds.came_to_rest(k) && !net.prescribed(net.network.sliders[k].branch)))) return true;
  }
  return false;
}

/// Whether a slider stands for losses of a gear and is at a bound, as it is without a load on the gear. At the end of h its bounds follow from the load there.
bool LookAhead::at_loss(std::size_t slider) const {
  const EventNetwork& net = event_->net;
  const int train = net.network.sliders[slider].train;
  if (train < 0) return false;
  double size = 0;
  for (const NodeId node : net.network.trains[at(train)].node) size = std::max(size, event_->nodal.magnitude[at(node)]);
  const double force = event_->force[slider];
  return std::min(event_->bounds.bound(slider, 1) - force, event_->bounds.bound(slider, -1) + force) <= numerics::balance_roundoff * size;
}

bool LookAhead::stops_within() const {
  const EventNetwork& net = event_->net;
  for (std::size_t k = 0; k < slider_.size(); ++k) {
    const Branch& b = net.network.sliders[k].branch;
    if (event_->bounds.came_to_rest(k) != 0 || net.massless(b.a) || net.massless(b.b)) continue;
    const double va = event_->state.velocity[at(b.a)], vb = event_->state.velocity[at(b.b)];
    const bool goes_on = apart(net.network, net.network.sliders[k]) || problem_.direction(slider_[k]) == (va > vb ? 1 : -1);
    if (!goes_on && std::abs(va - vb) > numerics::equal_velocities * (std::abs(va) + std::abs(vb))) return true;
  }
  return false;
}

bool LookAhead::reversed(int branch) const {
  const EventNetwork& net = event_->net;
  const Branch& b = net.network.deflections[at(branch)];
  return contains(event_->fired.turns, branch) && (net.massless(b.a) || net.massless(b.b)) && !net.may_stand(branch);
}

bool LookAhead::same_velocity(NodeId a, NodeId b) const {
  const EventNetwork& net = event_->net;
  const double speeds = std::abs(problem_.value(net.slot(a))) + std::abs(problem_.value(net.slot(b)));
  return std::abs(problem_.difference(net.slot(a), net.slot(b))) <= numerics::equal_velocities * speeds;
}

void LookAhead::join_given(DisjointSets& sets) const {
  const EventNetwork& net = event_->net;
  std::vector<NodeId> given;
  for (std::size_t n = 0; n < net.structure.kind.size(); ++n) {
    if (net.structure.kind[n] == Kind::known) given.push_back(static_cast<NodeId>(n));
  }
  const auto value = [&](NodeId node) { return problem_.value(net.slot(node)); };
  std::stable_sort(given.begin(), given.end(), [&](NodeId a, NodeId b) { return value(a) < value(b); });
  for (std::size_t k = 1; k < given.size(); ++k) {
    if (same_velocity(given[k - 1], given[k])) sets.join(given[k - 1], given[k]);
  }
}

double LookAhead::beyond_bound(std::size_t k) const {
  return problem_.force(slider_[k]) - bound_side_[k] * h_ * event_->bounds.rate(k, bound_side_[k]);
}

}  // namespace rheonet
