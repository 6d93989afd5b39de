#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/base/roundoff.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

namespace {

constexpr double different = numerics::different_velocities * numerics::equal_velocities;

double speed_at(const Dae::View& view, const Branch& b) {
  return std::max(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
}

}  // namespace

/// Finds the parts of the network that known nodes separate: round-off in one part does not reach the others.
void Tolerances::find_parts() {
  const Structure& structure = dae_->structure();
  DisjointSets parts(structure.kind.size());
  const auto join = [&](const Branch& b) {
    if (structure.kind[at(b.a)] != Kind::known && structure.kind[at(b.b)] != Kind::known) parts.join(b.a, b.b);
  };
  for (const Branch& b : structure.deflections) join(b);
  for (const Branch& b : structure.rates) join(b);
  for (const Branch& b : structure.sliders) join(b);
  part_.clear();
  for (std::size_t n = 0; n < structure.kind.size(); ++n) part_.push_back(parts.find(static_cast<NodeId>(n)));
}

/// Flags the unknowns that jitter with the round-off of time: in parts with dashpots or friction, which follow their inputs
/// directly. With springs, masses and ideal sliders alone, without delays, a motion depends on step sizes, not on time.
void Tolerances::find_jitter() {
  const Structure& structure = dae_->structure();
  std::vector<char> dissipates(structure.kind.size(), 0);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->creeps(i) || laws.batch->events(i) > 0) dissipates[at(part_of(structure.deflections[at(laws.first) + i]))] = 1;
    }
  }
  for (const Branch& b : structure.rates) dissipates[at(part_of(b))] = 1;
  if (dae_->inputs().history().any()) {
    for (const Branch& b : structure.sliders) dissipates[at(part_of(b))] = 1;
  }
  jitters_.assign(quantity_.size(), 1);
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const Quantity& q = quantity_[i];
    if (q.sort == Sort::velocity || q.sort == Sort::position) jitters_[i] = dissipates[at(part_[q.index])];
    if (q.sort == Sort::deflection) jitters_[i] = dissipates[at(part_of(structure.deflections[q.index]))];
  }
}

int Tolerances::part_of(const Branch& b) const {
  return part_[at(dae_->structure().kind[at(b.a)] == Kind::known ? b.b : b.a)];
}

/// Largest force and velocity of each part; stiffness and damping around each node; law of each deflection branch.
struct Tolerances::Loads {
  std::vector<double> force, speed;        ///< N, m/s
  std::vector<double> stiffness, damping;  ///< N/m, N s/m
  std::vector<double> f, df, dc;           ///< N, N/m, 1/s
};

Tolerances::Loads Tolerances::find_loads(const Dae::View& view) const {
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
    const std::size_t part = at(part_of(b));
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
    double& largest = loads.force[at(part_[n])];
    largest = std::max(largest, std::abs(view.applied[n]));
  }
  return loads;
}

/// Finds the round-off of all unknowns. Forces F in balance and equal velocities V leave a velocity eps (V + F/sqrt(k m)) at
/// a mass and eps (V + F/B) at a node that dashpots hold. They leave a deflection eps F/k, and the integral of eps V until it
/// has crept away. Otherwise steps would resolve the round-off of a network in equilibrium. A mass on a spring so soft, or a dashpot
/// so thin, that the run ends long before it would come to an equilibrium moves as if it were free: round-off leaves nothing there.
void Tolerances::find_rounding(const Dae::View& view) {
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  const Loads loads = find_loads(view);
  const auto known = [&](NodeId node) { return structure.kind[at(node)] == Kind::known; };
  const double time = network_.scene->stop - network_.scene->start;
  const auto mobility = [&](NodeId node) { return known(node) ? 0 : time * time / structure.inertia[at(node)]; };  // m/N
  const auto settled = [](double way) { return way < 1 ? way * way : 1; };  // way: towards the equilibrium within the run
  plain_rounding_.assign(structure.kind.size(), 0);
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    const auto [sort, k] = quantity_[i];
    rounding_[i] = 0;
    drift_[i] = {};
    if (sort == Sort::velocity) {
      const double m = structure.inertia[k], impedance = std::sqrt(m * loads.stiffness[k]) + loads.damping[k];
      const std::size_t part = at(part_[k]);
      rounding_[i] = eps * (loads.speed[part] + (impedance > 0 ? settled(impedance * time / m) * loads.force[part] / impedance : 0));
      plain_rounding_[part] = std::max(plain_rounding_[part], rounding_[i]);
    } else if (sort == Sort::deflection) {
      const Branch& b = structure.deflections[k];
      const bool alone = known(b.a) && known(b.b);
      const std::size_t part = at(part_of(b));
      const double f = std::abs(loads.f[k]), df = std::abs(loads.df[k]), dc = std::abs(loads.dc[k]);
      // Friction at its bound has hardly any slope: its secant then limits its deflection.
      const double slope = std::max(df, view.p[k] != 0 ? f / std::abs(view.p[k]) : 0);
      const bool in_balance = structure.group[at(b.a)] >= 0 || structure.group[at(b.b)] >= 0;
      const double share = in_balance ? numerics::restart_balance_terms * numerics::equation_roundoff : eps;
      if (df != 0) rounding_[i] += share * (alone ? f : settled(slope * (mobility(b.a) + mobility(b.b))) * loads.force[part]) / slope;
      drift_[i] = {eps * (alone ? speed_at(view, b) : loads.speed[part]), dc != 0 ? 1 / dc : std::numeric_limits<double>::infinity()};
    } else if (sort == Sort::force) {
      rounding_[i] = eps * loads.force[at(part_of(structure.rates[k]))];
    }
  }
  // Each node of a train has the round-off of the others.
  for (const Structure::Tied& tied : structure.tied) {
    std::vector<std::pair<int, double>> unknowns{{dae_->velocity_unknown(tied.pivot), 1}};
    for (const auto& [node, factor] : tied.terms) unknowns.emplace_back(dae_->velocity_unknown(node), std::abs(factor));
    double sum = 0;
    for (const auto& [unknown, factor] : unknowns) sum += unknown < 0 ? 0 : factor * rounding_[at(unknown)];
    for (const auto& [unknown, factor] : unknowns) {
      if (unknown >= 0) rounding_[at(unknown)] = std::max(rounding_[at(unknown)], sum / factor);
    }
  }
  rounding_at_rest_ = plain_rounding_;
  find_dashpot_rounding(view);
  if (!block_rounding_.empty()) {
    stiffness_around_ = loads.stiffness;
    damping_around_ = loads.damping;
    find_block_rounding();
  }
  force_rounding_.assign(structure.kind.size(), 0);
  find_force_rounding(view);
  find_rounding_now(view);
}

/// After a restart at which something moved fast for a moment, as where a force steps at a thin dashpot, the round-off of those velocities would go on adding up
/// in deflections for the rest of the run. Where that decides a tolerance, it is found anew, each time when the time since the restart has doubled.
void Tolerances::find_drift_again(double t, const Dae::View& view) {
  if (!drift_dominates_ || t - restarted_ < 2 * (drift_found_ - restarted_)) return;
  drift_found_ = t;
  drift_dominates_ = false;
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const Loads loads = find_loads(view);
  for (std::size_t i = 0; i < quantity_.size(); ++i) {
    if (quantity_[i].sort != Sort::deflection) continue;
    const Branch& b = dae_->structure().deflections[quantity_[i].index];
    const double speed = std::max(speed_at(view, b), loads.speed[at(part_of(b))]);
    // A motion may just turn round: its speed is not forgotten at once.
    drift_[i].velocity = std::min(drift_[i].velocity, std::max(eps * speed, numerics::drift_kept * drift_[i].velocity));
  }
}

/// A block that turns a position into a force also amplifies the round-off of that position. A spring made of blocks between
/// two positions far from 0 has their round-off in its force, which shakes the mass that it holds.
void Tolerances::find_block_rounding() {
  if (block_rounding_.empty()) return;
  constexpr double eps = numerics::block_term_ulps * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  BlockSignals& blocks = dae_->inputs().blocks();
  blocks.update_slopes(dae_->inputs().history());
  std::vector<double> rounding(structure.kind.size(), 0), stiffness = stiffness_around_, damping = damping_around_;
  for (const Network::Force& force : network_.forces) {
    if (force.block < 0) continue;
    double sum = 0;
    for (std::size_t atom = 0; atom < blocks.atoms(); ++atom) {
      const double slope = std::abs(blocks.slope(force.block, atom));
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
    block_rounding_[n] = impedance > 0 ? rounding[n] / impedance : 0;
  }
}

/// Finds the round-off of forces. A dilatant law turns it into a much larger round-off of the velocity, the most at rest. The
/// round-off of forces never decreases until the next restart.
void Tolerances::find_force_rounding(const Dae::View& view) {
  constexpr double eps = numerics::newton_alternation * numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  const Structure& structure = dae_->structure();
  const std::vector<double>& slope = dae_->slopes();
  const auto add = [&](NodeId part, double f) { force_rounding_[at(part)] = std::max(force_rounding_[at(part)], eps * std::abs(f)); };
  const auto meet = [&](const Branch& b, double f) {
    if (structure.kind[at(b.a)] != Kind::known || structure.kind[at(b.b)] != Kind::known) add(part_of(b), f);
  };
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    meet(structure.deflections[j], view.f[j]);
    meet(structure.deflections[j], slope[j] * view.p[j]);
  }
  for (std::size_t r = 0; r < structure.rates.size(); ++r) meet(structure.rates[r], view.rate_force[r]);
  for (std::size_t k = 0; k < structure.sliders.size(); ++k) meet(structure.sliders[k], view.slider_force[k]);
  for (std::size_t n = 0; n < part_.size(); ++n) add(part_[n], view.applied[n]);
  for (std::size_t r = 0; any_solved_ && r < dashpot_rounding_.size(); ++r) {
    if (dae_->force_unknown(static_cast<int>(r)) >= 0) continue;
    double& largest = force_rounding_[at(part_of(structure.rates[r]))];
    largest = std::max(largest, numerics::newton_alternation * dashpot_rounding_[r]);
  }
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t, int part) {
    double& largest = rounding_at_rest_[at(part)];
    largest = std::max(largest, law.velocity_at(i, force_rounding_[at(part)]));
  });
}

double Tolerances::unresolved() const {
  return std::max(relative_ * largest_velocity_, *std::max_element(plain_rounding_.begin(), plain_rounding_.end()));
}

/// Finds the round-off of the forces of dashpots due to that of the velocities at their ends. With a small exponent it is
/// large near rest.
void Tolerances::find_dashpot_rounding(const Dae::View& view) {
  if (!any_solved_) return;
  constexpr double eps = numerics::balanced_force_ulps * std::numeric_limits<double>::epsilon();
  for (std::size_t r = 0; r < dashpot_rounding_.size(); ++r) {
    const Branch& b = dae_->structure().rates[r];
    std::size_t i = 0;
    const RateBatch& law = network_.rate_of(static_cast<int>(r), i);
    const double w = std::abs(view.rate_velocity[r]), grain = b.a == b.b ? 0 : eps * speed_at(view, b);
    dashpot_rounding_[r] = law.force_at(i, w + grain) - law.force_at(i, w);
  }
}

/// The round-off of velocities with the present forces of dilatant laws.
void Tolerances::find_rounding_now(const Dae::View& view) {
  rounding_now_ = plain_rounding_;
  if (!dae_->rough()) return;
  for_each_dilatant([&](const RateBatch& law, std::size_t i, std::size_t r, int part) {
    const double f = std::abs(view.rate_force[r]), rounding = force_rounding_[at(part)];
    double& largest = rounding_now_[at(part)];
    largest = std::max(largest, law.velocity_at(i, f + rounding) - law.velocity_at(i, f));
  });
}

/// If both ends of a branch move almost alike, its own velocity is their round-off: one end hangs free, say, or a thin gel
/// rides on thick oil.
void Tolerances::find_difference_rounding(const Dae::View& view) {
  const auto rounding = [&](const Branch& b) {
    return different * std::min(std::abs(view.velocity[at(b.a)]), std::abs(view.velocity[at(b.b)]));
  };
  const Structure& structure = dae_->structure();
  for (std::size_t j = 0; j < difference_rounding_.size(); ++j) difference_rounding_[j] = rounding(structure.deflections[j]);
  for (std::size_t k = 0; k < slide_rounding_.size(); ++k) slide_rounding_[k] = rounding(structure.sliders[k]);
}

/// Lists the unknowns whose error is that of the forces that they balance: forces of dashpots, and deflections of laws held
/// at rest, which may take any force. A dashpot's force that no balance determines follows from a velocity, and has its
/// round-off.
void Tolerances::find_balances() {
  followers_.clear();
  if (!any_balanced_) return;
  const Structure& structure = dae_->structure();
  std::vector<Branch> open;
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    if (dae_->force_unknown(static_cast<int>(r)) < 0) continue;
    followers_.push_back({Sort::force, r, false});
    open.push_back(structure.rates[r]);
  }
  const std::size_t dashpots = open.size();
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    if (dae_->deflection_unknown(static_cast<int>(j)) < 0) continue;
    std::size_t i = 0;
    const bool held = network_.batch_of(static_cast<int>(j), i).holds(i);
    if (balanced_[j] < 0 && !held) continue;
    followers_.push_back({Sort::deflection, j, held});
    open.push_back(structure.deflections[j]);
  }
  balanced_forces_.attach(structure, std::move(open), dashpots);
}

void Tolerances::loosen_balanced_forces(const std::vector<double>& slope) {
  if (followers_.empty()) return;
  const Structure& structure = dae_->structure();
  balanced_forces_.begin();
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    if (dae_->force_unknown(static_cast<int>(r)) < 0) balanced_forces_.add_told(structure.rates[r], dashpot_rounding_[r]);
  }
  const std::vector<double>& seen = seen_[static_cast<std::size_t>(Sort::deflection)];
  longest_at_.assign(structure.kind.size(), 0);
  std::size_t next = 0;  // of the followers, which are in the order of their branches
  while (next < followers_.size() && followers_[next].sort == Sort::force) ++next;
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const Branch& b = structure.deflections[j];
    for (const NodeId node : {b.a, b.b}) longest_at_[at(node)] = std::max(longest_at_[at(node)], seen[j]);
    const int unknown = dae_->deflection_unknown(static_cast<int>(j));
    if (next < followers_.size() && followers_[next].index == j) {
      ++next;
    } else if (unknown >= 0) {
      balanced_forces_.add_told(b, std::abs(slope[j]) * tolerance_[at(unknown)]);
    }
  }
  balanced_forces_.find([&](std::size_t k) { return dashpot_rounding_[followers_[k].index]; });
  for (std::size_t k = 0; k < followers_.size(); ++k) {
    const Follower& f = followers_[k];
    const double dead_band = balanced_forces_.dead_band(k);
    if (f.sort == Sort::force) {
      double& tolerance = tolerance_[at(dae_->force_unknown(static_cast<int>(f.index)))];
      tolerance = std::max(tolerance, dead_band);
    } else if (slope[f.index] != 0) {
      double& tolerance = tolerance_[at(dae_->deflection_unknown(static_cast<int>(f.index)))];
      const double all = dead_band / std::abs(slope[f.index]);
      // Where friction has hardly any slope, its deflection determines the position of its end: hence the limit.
      tolerance = std::max(tolerance, f.held ? all : std::min(all, local() * longest_at_[at(balanced_[f.index])]));
    }
  }
}

/// Positions of nodes that springs and friction hold follow from deflections, which are rounded, and which a restart leaves off by the
/// round-off of their balance.
void Tolerances::find_way_rounding() {
  const Structure& structure = dae_->structure();
  const std::vector<double>& seen = seen_[static_cast<std::size_t>(Sort::deflection)];
  way_rounding_.assign(part_.size(), 0);
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int unknown = dae_->deflection_unknown(static_cast<int>(j));
    if (unknown < 0) continue;
    double& most = way_rounding_[at(part_of(structure.deflections[j]))];
    most = std::max({most, numerics::sum_ulps * std::numeric_limits<double>::epsilon() * seen[j], rounding_[at(unknown)]});
  }
}

}  // namespace rheonet
