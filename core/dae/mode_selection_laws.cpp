// Nodes, inputs and laws of elements in the convex problem of a mode selection.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/mode_selection.hpp"
#include "core/dae/rate_law.hpp"

namespace rheonet {

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

/// Friction at its bound: it leaves the bound with this slope at velocities below its creep, and keeps its force above.
ConvexNetwork::Law EventTransition::released(ConvexNetwork::Law law, double slope, double creep) {
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
ConvexNetwork::Law EventTransition::law_of(const RateBatch& batch, std::size_t i, double w0, double scale, double steepest) {
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

}  // namespace rheonet
