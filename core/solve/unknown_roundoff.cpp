#include "core/solve/unknown_roundoff.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"

namespace rheonet {

namespace {

using Sort = Unknown::Sort;

constexpr double different = numerics::different_velocities * numerics::equal_velocities;
constexpr double of_sum = numerics::sum_ulps * std::numeric_limits<double>::epsilon();

double speed_at(const Dae::View& view, const Branch& b) {
  return std::max(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
}

}  // namespace

/// Largest force and velocity of each part; stiffness and damping around each node; law of each deflection branch.
struct UnknownRoundoff::Loads {
  std::vector<double> force, speed;        ///< N, m/s
  std::vector<double> stiffness, damping;  ///< N/m, N s/m
  std::vector<double> f, df, dc;           ///< N, N/m, 1/s
};

UnknownRoundoff::UnknownRoundoff(const Network& network, const SeparatedParts& parts)
    : network_(network), parts_(parts), difference_(network.deflections.size(), 0), slide_(network.sliders.size(), 0) {
  if (!network.blocks.sensors.empty()) blocks_.assign(network.nodes(), 0);
}

void UnknownRoundoff::attach(Dae& dae, const std::vector<Unknown>& unknowns) {
  dae_ = &dae;
  unknowns_ = &unknowns;
  any_solved_ = std::any_of(unknowns.begin(), unknowns.end(), [](const Unknown& q) { return q.sort == Sort::force; });
  dashpot_.assign(network_.rates.size(), 0);
  grain_.assign(unknowns.size(), 0);
  near_0_.assign(unknowns.size(), 0);
  drift_.assign(unknowns.size(), {});
  find_jitter();
  balance_.attach(network_, dae.structure());
}

void UnknownRoundoff::restart(double t, const Dae::View& view) {
  restarted_ = drift_found_ = t;
  const Loads loads = find_loads(view);
  find_unknowns(loads, view);
  spread_over_trains();
  at_rest_ = plain_;
  find_dashpots(view);
  if (!blocks_.empty()) {
    stiffness_around_ = loads.stiffness;
    damping_around_ = loads.damping;
    find_blocks();
  }
  force_.assign(dae_->structure().kind.size(), 0);
  find_forces(view);
  find_now(view);
  find_differences(view);
}

void UnknownRoundoff::follow(double t, const Dae::View& view) {
  find_differences(view);
  find_blocks();  // forces of blocks may begin long after a restart
  find_drift_again(t, view);
  find_dashpots(view);
  if (!dae_->rough()) return;
  find_forces(view);
  find_now(view);
}

void UnknownRoundoff::find(const Dae::View& view, const std::vector<double>& slope, const Magnitudes& seen) {
  if (!balance_.none()) balance_.find(view, slope);
  if (!dae_->positions().integrated.empty()) find_ways(seen);
  find_ties(view);
}

double UnknownRoundoff::raise(std::size_t i, double tolerance, double size, const At& now, double jitter, double stopping) {
  const auto [sort, k] = (*unknowns_)[i];
  tolerance = std::max({tolerance, jitters_[i] ? jitter : 0.0, near_0_[i]});
  if (sort == Sort::deflection) {
    grain_[i] = balance_.of(static_cast<int>(k));
    tolerance = std::max({tolerance, of_sum * size, now.step * difference_[k], numerics::deflection_balance_ratio * grain_[i]});
  }
  if (sort == Sort::velocity) tolerance = raise_velocity(k, i, tolerance, jitter, stopping);
  // A stop far from 0 may deflect by less than the round-off of its position.
  if (sort == Sort::position) tolerance = std::max({tolerance, of_sum * size, way_[at(parts_.of(dae_->structure().rigid[k]))]});
  Drift drift = sort == Sort::position ? Drift{now_[at(parts_.of(static_cast<NodeId>(k)))]} : drift_[i];
  if (!tied_.empty()) {
    if (sort == Sort::position) drift.velocity = std::max(drift.velocity, tied(k));
    if (sort == Sort::deflection) drift.velocity = std::max(drift.velocity, tied(dae_->structure().deflections[k]));
  }
  // An error test compares a step with those since the restart: earlier round-off does not enter.
  const double adds_up = now.time - (sort == Sort::position ? now.begin : restarted_);
  const double drifted = drift.velocity * std::min(adds_up, drift.lasting);
  if (!(drifted > tolerance)) return tolerance;
  drift_dominates_ = drift_dominates_ || sort == Sort::deflection;
  return drifted;
}

double UnknownRoundoff::raise_velocity(std::size_t node, std::size_t i, double tolerance, double jitter, double stopping) {
  if (!blocks_.empty()) {
    grain_[i] = blocks_[node];
    tolerance = std::max(tolerance, grain_[i]);
  }
  if (!network_.trains.empty()) {
    grain_[i] = std::max(blocks_.empty() ? 0 : grain_[i], tied(node));
    tolerance = std::max(tolerance, grain_[i]);
  }
  if (dae_->structure().inertia[node] == 0) tolerance = std::max(tolerance, now_[at(parts_.of(static_cast<NodeId>(node)))]);
  return std::min(tolerance, std::max(stopping, jitter));
}

double UnknownRoundoff::plain() const { return *std::max_element(plain_.begin(), plain_.end()); }

double UnknownRoundoff::at_rest(const Branch& b) const {
  const Structure& structure = dae_->structure();
  // Round-off of forces causes a velocity, through dashpots, only at nodes without mass.
  const auto heavy = [&](NodeId node) { return structure.kind[at(node)] == Kind::known || structure.inertia[at(node)] > 0; };
  return heavy(b.a) && heavy(b.b) ? 0 : at_rest_[at(parts_.of(b))];
}

/// Flags the unknowns that jitter with the round-off of time: in parts with dashpots or friction, which follow their inputs
/// directly. With springs, elastic stops, masses and ideal sliders alone, without delays, a motion depends on step sizes, not on time. An impact
/// happens at a time.
void UnknownRoundoff::find_jitter() {
  const Structure& structure = dae_->structure();
  std::vector<char> dissipates(structure.kind.size(), 0);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->creeps(i) || !laws.batch->knows_heat()) dissipates[at(parts_.of(structure.deflections[at(laws.first) + i]))] = 1;
    }
  }
  for (const Branch& b : structure.rates) dissipates[at(parts_.of(b))] = 1;
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) {
    if (network_.sliders[k].contact || dae_->inputs().history().any()) dissipates[at(parts_.of(structure.sliders[k]))] = 1;
  }
  jitters_.assign(unknowns_->size(), 1);
  for (std::size_t i = 0; i < unknowns_->size(); ++i) {
    const Unknown& q = (*unknowns_)[i];
    if (q.sort == Sort::velocity || q.sort == Sort::position) jitters_[i] = dissipates[at(parts_.of(static_cast<NodeId>(q.index)))];
    if (q.sort == Sort::deflection) jitters_[i] = dissipates[at(parts_.of(structure.deflections[q.index]))];
  }
}


UnknownRoundoff::Loads UnknownRoundoff::find_loads(const Dae::View& view) const {
  const Structure& structure = dae_->structure();
  const std::size_t nodes = structure.kind.size(), count = structure.deflections.size();
  const std::vector<double> none(nodes, 0), of_branches(count);
  Loads loads{none, none, none, none, of_branches, of_branches, of_branches};
  const auto add = [](std::vector<double>& sum, const Branch& b, double x) {
    sum[at(b.a)] += x;
    sum[at(b.b)] += x;
  };
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  const auto meet = [&](const Branch& b, double f) {
    if (known(b.a) && known(b.b)) return;
    const std::size_t part = at(parts_.of(b));
    loads.force[part] = std::max(loads.force[part], std::abs(f));
    loads.speed[part] = std::max(loads.speed[part], speed_at(view, b));
  };
  std::vector<double> creep(count);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    const std::size_t k = at(laws.first);
    laws.batch->linearise(&view.p[k], &loads.f[k], &loads.df[k], &creep[k], &loads.dc[k]);
  }
  for (std::size_t j = 0; j < count; ++j) {
    add(loads.stiffness, structure.deflections[j], std::abs(loads.df[j]));
    meet(structure.deflections[j], loads.f[j]);
  }
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      meet(structure.rates[r], view.rate_force[r]);
      if (const double B = laws.batch->impulse(i); std::isfinite(B)) add(loads.damping, structure.rates[r], B);
    }
  }
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) meet(structure.sliders[k], view.slider_force[k]);
  for (std::size_t n = 0; n < nodes; ++n) {
    double& largest = loads.force[at(parts_.of(static_cast<NodeId>(n)))];
    largest = std::max(largest, std::abs(view.applied[n]));
  }
  return loads;
}


/// Finds the round-off of all unknowns. Forces F in balance and equal velocities V leave a velocity eps (V + F/sqrt(k m)) at
/// a mass and eps (V + F/B) at a node that dashpots hold. They leave a deflection eps F/k, and the integral of eps V until it
/// has crept away. Otherwise steps would resolve the round-off of a network in equilibrium. A mass on a spring so soft, or a dashpot
/// so thin, that the run ends long before it would come to an equilibrium moves as if it were free: round-off leaves nothing there.
void UnknownRoundoff::find_unknowns(const Loads& loads, const Dae::View& view) {
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  const double time = network_.scene->stop - network_.scene->start;
  const auto mobility = [&](NodeId node) { return known(node) ? 0 : time * time / structure.inertia[at(node)]; };  // m/N
  const auto settled = [](double way) { return way < 1 ? way * way : 1; };  // way: towards the equilibrium within the run
  plain_.assign(structure.kind.size(), 0);
  for (std::size_t i = 0; i < unknowns_->size(); ++i) {
    const auto [sort, k] = (*unknowns_)[i];
    near_0_[i] = 0;
    drift_[i] = {};
    if (sort == Sort::velocity) {
      const double m = structure.inertia[k], impedance = std::sqrt(m * loads.stiffness[k]) + loads.damping[k];
      const std::size_t part = at(parts_.of(static_cast<NodeId>(k)));
      near_0_[i] = eps * (loads.speed[part] + (impedance > 0 ? settled(impedance * time / m) * loads.force[part] / impedance : 0));
      plain_[part] = std::max(plain_[part], near_0_[i]);
    } else if (sort == Sort::deflection) {
      const Branch& b = structure.deflections[k];
      const bool alone = known(b.a) && known(b.b);
      const std::size_t part = at(parts_.of(b));
      const double f = std::abs(loads.f[k]), df = std::abs(loads.df[k]), dc = std::abs(loads.dc[k]);
      // Friction at its bound has hardly any slope: its secant then limits its deflection.
      const double slope = std::max(df, view.p[k] != 0 ? f / std::abs(view.p[k]) : 0);
      const bool in_balance = structure.group[at(b.a)] >= 0 || structure.group[at(b.b)] >= 0;
      const double share = in_balance ? numerics::restart_balance_terms * numerics::equation_roundoff : eps;
      if (df != 0) near_0_[i] += share * (alone ? f : settled(slope * (mobility(b.a) + mobility(b.b))) * loads.force[part]) / slope;
      drift_[i] = {eps * (alone ? speed_at(view, b) : loads.speed[part]), dc != 0 ? 1 / dc : std::numeric_limits<double>::infinity()};
    } else if (sort == Sort::force) {
      near_0_[i] = eps * loads.force[at(parts_.of(structure.rates[k]))];
    } else if (sort == Sort::block) {
      drift_[i] = drift_of_state(k);
    }
  }
}

/// A block's state integrates the round-off of the block's inputs. A lag forgets it with its time constant. The velocity in a law of the
/// netlist is a small difference where both ends move almost alike.
UnknownRoundoff::Drift UnknownRoundoff::drift_of_state(std::size_t state) const {
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const BlockSignals& blocks = dae_->inputs().blocks();
  double sum = 0;
  for (std::size_t sensor = 0; sensor < blocks.sensed.size(); ++sensor) {
    sum += std::abs(blocks.slopes().of_rate(state, blocks.states() + sensor) * blocks.sensed[sensor].value);
  }
  return {eps * sum, 1 / std::abs(blocks.slopes().of_rate(state, state))};
}

/// Each node of a train has the round-off of the others.
void UnknownRoundoff::spread_over_trains() {
  for (const Structure::TrainEquation& equation : dae_->structure().train_equations) {
    std::vector<std::pair<int, double>> unknowns{{dae_->indices().velocity[at(equation.pivot)], 1}};
    for (const auto& [node, factor] : equation.terms) unknowns.emplace_back(dae_->indices().velocity[at(node)], std::abs(factor));
    double sum = 0;
    for (const auto& [unknown, factor] : unknowns) sum += unknown < 0 ? 0 : factor * near_0_[at(unknown)];
    for (const auto& [unknown, factor] : unknowns) {
      if (unknown >= 0) near_0_[at(unknown)] = std::max(near_0_[at(unknown)], sum / factor);
    }
  }
}

/// After a restart at which something moved fast for a moment, as where a force steps at a thin dashpot, the round-off of those velocities would go on adding up
/// in deflections for the rest of the run. Where that decides a tolerance, it is found anew, each time when the time since the restart has doubled.
void UnknownRoundoff::find_drift_again(double t, const Dae::View& view) {
  if (!drift_dominates_ || t - restarted_ < 2 * (drift_found_ - restarted_)) return;
  drift_found_ = t;
  drift_dominates_ = false;
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const Loads loads = find_loads(view);
  for (std::size_t i = 0; i < unknowns_->size(); ++i) {
    if ((*unknowns_)[i].sort != Sort::deflection) continue;
    const Branch& b = dae_->structure().deflections[(*unknowns_)[i].index];
    const double speed = std::max(speed_at(view, b), loads.speed[at(parts_.of(b))]);
    // A motion may just turn round: its speed is not forgotten at once.
    drift_[i].velocity = std::min(drift_[i].velocity, std::max(eps * speed, numerics::drift_kept * drift_[i].velocity));
  }
}


/// A block that turns a position into a force also amplifies the round-off of that position. A spring made of blocks between
/// two positions far from 0 has their round-off in its force, which shakes the mass that it holds.
void UnknownRoundoff::find_blocks() {
  if (blocks_.empty()) return;
  constexpr double eps = numerics::block_term_ulps * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  BlockSignals& blocks = dae_->inputs().blocks();
  blocks.update_slopes(dae_->inputs().history());
  std::vector<double> rounding(structure.kind.size(), 0), stiffness = stiffness_around_, damping = damping_around_;
  for (const Network::Force& force : network_.forces) {
    if (force.block < 0) continue;
    double sum = 0;
    for (std::size_t atom = 0; atom < blocks.slopes().atoms(); ++atom) {
      const double slope = std::abs(blocks.slopes().of_output(force.block, atom));
      if (slope == 0) continue;
      const bool state = atom < blocks.states();
      sum += eps * slope * std::abs((state ? blocks.state[atom] : blocks.sensed[atom - blocks.states()]).value);
      if (state) continue;
      const Blocks::Sensor& sensor = network_.blocks.sensors[atom - blocks.states()];
      if (sensor.what == Blocks::Sensor::What::position) stiffness[at(structure.rigid[at(sensor.index)])] += slope;
      if (sensor.what == Blocks::Sensor::What::velocity) damping[at(structure.rigid[at(sensor.index)])] += slope;
    }
    for (const NodeId end : {force.a, force.b}) {
      if (end >= 0) rounding[at(structure.rigid[at(end)])] += sum;
    }
  }
  for (std::size_t n = 0; n < rounding.size(); ++n) {
    const double impedance = std::sqrt(stiffness[n] * structure.inertia[n]) + damping[n];
    blocks_[n] = impedance > 0 ? rounding[n] / impedance : 0;
  }
}


/// Finds the round-off of forces. A dilatant law turns it into a much larger round-off of the velocity, the most at rest. The
/// round-off of forces never decreases until the next restart.
void UnknownRoundoff::find_forces(const Dae::View& view) {
  constexpr double eps = numerics::newton_alternation * numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  const std::vector<double>& slope = dae_->slopes();
  const auto add = [&](NodeId part, double f) { force_[at(part)] = std::max(force_[at(part)], eps * std::abs(f)); };
  const auto meet = [&](const Branch& b, double f) {
    if (structure.kind[at(b.a)] != Kind::known || structure.kind[at(b.b)] != Kind::known) add(parts_.of(b), f);
  };
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    meet(structure.deflections[j], view.f[j]);
    meet(structure.deflections[j], slope[j] * view.p[j]);
  }
  for (std::size_t r = 0; r < structure.rates.size(); ++r) meet(structure.rates[r], view.rate_force[r]);
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) meet(structure.sliders[k], view.slider_force[k]);
  for (std::size_t n = 0; n < parts_.nodes(); ++n) add(parts_.of(static_cast<NodeId>(n)), view.applied[n]);
  for (std::size_t r = 0; any_solved_ && r < dashpot_.size(); ++r) {
    if (dae_->indices().force[r] >= 0) continue;
    double& largest = force_[at(parts_.of(structure.rates[r]))];
    largest = std::max(largest, numerics::newton_alternation * dashpot_[r]);
  }
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t, int part) {
    double& largest = at_rest_[at(part)];
    largest = std::max(largest, law.velocity_at(i, force_[at(part)]));
  });
}


/// Finds the round-off of the forces of dashpots due to that of the velocities at their ends. With a small exponent it is
/// large near rest.
void UnknownRoundoff::find_dashpots(const Dae::View& view) {
  if (!any_solved_) return;
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  for (std::size_t r = 0; r < dashpot_.size(); ++r) {
    const Branch& b = dae_->structure().rates[r];
    std::size_t i = 0;
    const RateBatch& law = network_.rate_of(static_cast<int>(r), i);
    const double w = std::abs(view.rate_velocity[r]), grain = b.a == b.b ? 0 : eps * speed_at(view, b);
    dashpot_[r] = law.force_at(i, w + grain) - law.force_at(i, w);
  }
}


/// The round-off of velocities with the present forces of dilatant laws.
void UnknownRoundoff::find_now(const Dae::View& view) {
  now_ = plain_;
  if (!dae_->rough()) return;
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t r, int part) {
    const double f = std::abs(view.rate_force[r]), rounding = force_[at(part)];
    double& largest = now_[at(part)];
    largest = std::max(largest, law.velocity_at(i, f + rounding) - law.velocity_at(i, f));
  });
}


/// If both ends of a branch move almost alike, its own velocity is their round-off: one end hangs free, say, or a thin gel
/// rides on thick oil.
void UnknownRoundoff::find_differences(const Dae::View& view) {
  const auto rounding = [&](const Branch& b) {
    return different * std::min(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
  };
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < difference_.size(); ++j) difference_[j] = rounding(structure.deflections[j]);
  for (std::size_t k = 0; k < slide_.size(); ++k) slide_[k] = rounding(structure.sliders[k]);
}


/// Positions of nodes that springs and friction hold follow from deflections, which are rounded, and which a restart leaves off by the
/// round-off of their balance.
void UnknownRoundoff::find_ways(const Magnitudes& seen) {
  const Structure& structure = dae_->structure();
  const std::vector<double>& longest = seen.unknown[static_cast<std::size_t>(Sort::deflection)];
  way_.assign(parts_.nodes(), 0);
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->indices().deflection[j];
    if (unknown < 0) continue;
    double& most = way_[at(parts_.of(structure.deflections[j]))];
    most = std::max({most, numerics::sum_ulps * std::numeric_limits<double>::epsilon() * longest[j], near_0_[at(unknown)]});
  }
}

/// Velocities at a train follow from each other: the slowest is known to the round-off of the fastest.
void UnknownRoundoff::find_ties(const Dae::View& view) {
  tied_.assign(network_.trains.empty() ? 0 : network_.nodes(), 0);
  for (const Structure::TrainEquation& equation : dae_->structure().train_equations) {
    double sum = std::abs(view.velocity[at(equation.pivot)]);
    for (const auto& [node, factor] : equation.terms) sum += std::abs(factor * view.velocity[at(node)]);
    sum *= of_sum;
    const auto round = [&](NodeId node, double factor) { tied_[at(node)] = std::max(tied_[at(node)], sum / std::abs(factor)); };
    round(equation.pivot, 1);
    for (const auto& [node, factor] : equation.terms) round(node, factor);
  }
}

}  // namespace rheonet
