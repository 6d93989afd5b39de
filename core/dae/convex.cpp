#include "core/dae/convex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr double value_rounding = numerics::law_value_ulps * std::numeric_limits<double>::epsilon();
constexpr double difference_rounding = numerics::sum_ulps * std::numeric_limits<double>::epsilon();

}  // namespace

ConvexNetwork::ConvexNetwork(int nodes)
    : origin_(at(nodes), 0), base_(origin_), u_(origin_), inertia_(origin_), applied_(origin_), fixed_(at(nodes), 0), tied_(fixed_), given_(origin_), clusters_(nodes), torn_clusters_(0) {}

void ConvexNetwork::fix(int node, double change) {
  fixed_[at(node)] = 1;
  u_[at(node)] = given_[at(node)] = change;
}

// Round-off must not separate nodes that are together, or were until a branch released them: a massless node takes both numbers
// (base and u) of the node that it follows.
void ConvexNetwork::follow(int node, int head) {
  if (firm(at(node))) {
    u_[at(node)] = (base_[at(head)] - base_[at(node)]) + u_[at(head)];
  } else {
    base_[at(node)] = base_[at(head)];
    u_[at(node)] = u_[at(head)];
  }
}

double ConvexNetwork::difference(int a, int b) const {
  const double start = base_[at(a)] - base_[at(b)], w = start + (u_[at(a)] - u_[at(b)]);
  return std::abs(w) <= difference_rounding * (std::abs(start) + std::abs(u_[at(a)]) + std::abs(u_[at(b)])) ? 0 : w;
}

int ConvexNetwork::add(int a, int b, Law law) {
  const bool jumps = law.low < law.high;
  branches_.push_back({.a = a, .b = b, .law = std::move(law), .jumps = jumps});
  return static_cast<int>(branches_.size()) - 1;
}

int ConvexNetwork::direction(int branch) const {
  const Branch& b = branches_[at(branch)];
  if (b.stuck) return 0;
  return b.w > 0 ? 1 : b.w < 0 ? -1 : b.jumps ? b.side : 0;
}

double ConvexNetwork::force(int branch) const {
  const Branch& b = branches_[at(branch)];
  return b.stuck ? bond_force_[at(branch)] : b.force(b.w, b.side);
}

double ConvexNetwork::Branch::force(double w, int of_side) const {
  if (w > 0 || (w == 0 && of_side > 0)) {
    double slope;
    return w > 0 && law.beyond ? law.beyond(w, slope) + weak * w : law.high + (law.forward + weak) * w;
  }
  double slope;
  return w < 0 && law.beyond ? law.beyond(w, slope) + weak * w : law.low + (law.backward + weak) * w;
}

double ConvexNetwork::Branch::slope(double w) const {
  if (w != 0 && law.beyond) {
    double result = 0;
    law.beyond(w, result);
    return result + weak;
  }
  if (w == 0 && !jumps) return std::max(law.forward, law.backward) + weak;
  return (w > 0 || (w == 0 && side > 0) ? law.forward : law.backward) + weak;
}

void ConvexNetwork::find_restrained() {
  DisjointSets rigid(u_.size());
  for (const Branch& b : branches_) {
    if (b.law.inertial || (std::isinf(b.law.low) && std::isinf(b.law.high))) rigid.join(b.a, b.b);
  }
  std::vector<char> restrained(u_.size(), 0);
  for (std::size_t k = 0; k < u_.size(); ++k) restrained[at(rigid.find(static_cast<int>(k)))] |= fixed_[k] || inertia_[k] > 0 || (tied_[k] && any_inertia_);
  restrained_.resize(u_.size());
  for (std::size_t k = 0; k < u_.size(); ++k) restrained_[k] = restrained[at(rigid.find(static_cast<int>(k)))];
}

void ConvexNetwork::choose_weak() {
  constexpr double none = std::numeric_limits<double>::infinity();
  // Nodes that move with each other, up to those that are held: a soft element far along a chain may hold all of them.
  DisjointSets together(u_.size());
  for (const Branch& b : branches_) {
    if (!restrained(at(b.a)) && !restrained(at(b.b))) together.join(b.a, b.b);
  }
  // The least slope and the least bounds around the nodes that move with each node, at their representative.
  std::vector<double> least(u_.size(), none), least_bounds(least);
  const auto meet = [&](std::vector<double>& of, int node, double value) { of[at(together.find(node))] = std::min(of[at(together.find(node))], value); };
  const auto bounds = [](const Branch& b) {
    double sum = 0;
    for (const double bound : {b.law.low, b.law.high}) sum += std::isfinite(bound) ? std::abs(bound) : 0;
    return sum;
  };
  double farthest = 0, least_of_all = none;
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (inertia_[k] > 0) meet(least, static_cast<int>(k), inertia_[k]);
    farthest = std::max(farthest, std::abs(base_[k] + u_[k]));
  }
  for (const Branch& b : branches_) {
    const double slope = std::max(b.law.forward, b.law.backward);
    for (int node : {b.a, b.b}) {
      if (slope > 0) meet(least, node, slope);
      if (bounds(b) > 0) meet(least_bounds, node, bounds(b));
    }
  }
  for (const double slope : least) least_of_all = std::min(least_of_all, slope);
  for (Branch& b : branches_) {
    if (restrained(at(b.a)) && restrained(at(b.b))) continue;  // no regularisation needed
    const double steeper = std::max(b.law.forward, b.law.backward), flatter = std::min(b.law.forward, b.law.backward);
    if (!b.jumps && flatter > numerics::flat_law * steeper) continue;
    const double around = std::min(least[at(together.find(b.a))], least[at(together.find(b.b))]);
    // The slope of a mass is its inertia over the time step: 1e-9 of it is a large force at the mass's present velocity.
    const double force = bounds(b) > 0 ? bounds(b) : std::min(least_bounds[at(together.find(b.a))], least_bounds[at(together.find(b.b))]);
    b.weak = std::min(numerics::regularising_slope * around, farthest > 0 ? numerics::regularising_force * force / farthest : none);
    if (b.weak == none) b.weak = numerics::regularising_slope * (least_of_all < none ? least_of_all : 1);
  }
}

/// Branches between equal start values stick; massless nodes follow nodes to which they can stick.
void ConvexNetwork::stick_at_first() {
  const std::size_t n = u_.size();
  DisjointSets sets(n);
  std::vector<char> heavy(n, 0);  // of each set: its value is given
  std::vector<int> head(n);       // the node that gives it
  for (std::size_t k = 0; k < n; ++k) {
    heavy[k] = firm(k);
    head[k] = static_cast<int>(k);
  }
  std::vector<char> fixed(fixed_);
  // Branches with an infinite bound come first.
  std::vector<Branch*> order;
  for (const bool strict : {true, false}) {
    for (Branch& b : branches_) {
      if (b.jumps && (std::isinf(b.law.low) || std::isinf(b.law.high)) == strict) order.push_back(&b);
    }
  }
  const auto apart = [&](const Branch& b) { return difference(head[at(sets.find(b.a))], head[at(sets.find(b.b))]); };
  const auto stick = [&](Branch& b) {
    const int sa = sets.find(b.a), sb = sets.find(b.b);
    b.stuck = true;
    if (sa == sb) return;
    const bool given = heavy[at(sa)] || heavy[at(sb)];
    const bool first = fixed[at(sa)] || (!fixed[at(sb)] && heavy[at(sa)]);
    const int common = head[at(first ? sa : sb)];
    const bool firm = fixed[at(sa)] || fixed[at(sb)];
    sets.join(sa, sb);
    fixed[at(sets.find(sa))] = firm;
    heavy[at(sets.find(sa))] = given;
    head[at(sets.find(sa))] = common;
  };
  for (Branch* b : order) {
    const double w = apart(*b);
    if (w != 0 && !b->law.forbids(w) && heavy[at(sets.find(b->a))] && heavy[at(sets.find(b->b))]) {
      b->side = w > 0 ? 1 : -1;
    } else {
      stick(*b);
    }
  }
  // A node that takes the value of others may then move the way that a branch looked at before forbids.
  for (bool again = true; again;) {
    again = false;
    for (Branch* b : order) {
      const double w = b->stuck ? 0 : apart(*b);
      if (w == 0 || !b->law.forbids(w)) continue;
      stick(*b);
      again = true;
    }
  }
  for (std::size_t k = 0; k < n; ++k) follow(static_cast<int>(k), head[at(sets.find(static_cast<int>(k)))]);
}

/// Merges the nodes that sticking branches and equations join into clusters, each at one value.
void ConvexNetwork::merge() {
  DisjointSets sets(u_.size());
  for (const Branch& b : branches_) {
    if (b.stuck) sets.join(b.a, b.b);
  }
  join_by_equations(sets);
  clusters_.merge(sets, [&](std::size_t k) { return fixed_[k] ? std::numeric_limits<double>::infinity() : inertia_[k]; });
  for (int k = 0; at(k) < u_.size(); ++k) follow(k, clusters_.head(k));
  for (Branch& b : branches_) {
    if (clusters_.joined(b.a, b.b)) b.w = nodal_difference(b);
  }
}

/// Sums the forces at all free clusters; true if the sums are round-off.
bool ConvexNetwork::balanced(Sums& sums) const {
  sums.all.assign(at(clusters_.columns()), 0);
  std::vector<double>& rounding = sums.rounding;
  rounding = sums.all;
  const auto add = [&](int node, double f) {
    const int column = clusters_.column(node);
    if (column < 0) return;
    sums.all[at(column)] += f;
    rounding[at(column)] += numerics::convex_balance_roundoff * std::abs(f);
  };
  // Round-off of the values themselves.
  const auto blur = [&](int node, double slope, double x) {
    const int column = clusters_.column(node);
    if (column >= 0) rounding[at(column)] += value_rounding * slope * std::abs(x);
  };
  for (const Branch& b : branches_) {
    if (clusters_.joined(b.a, b.b)) continue;
    const double f = b.force(b.w, b.side);
    add(b.a, f);
    add(b.b, -f);
    blur(b.a, b.law.rounding, 1);
    blur(b.b, b.law.rounding, 1);
    for (int node : {b.a, b.b}) blur(node, b.slope(b.w), b.w);
  }
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const int node = static_cast<int>(k);
    add(node, -applied_[k]);
    if (inertia_[k] == 0) continue;
    add(node, inertia_[k] * u_[k]);
    blur(node, inertia_[k], u_[k]);
  }
  sums.laws = sums.all;
  for (const Equation& e : equations_) {
    for (std::size_t i = 0; i < e.node.size(); ++i) add(e.node[i], e.factor[i] * e.force);
  }
  bool met = true;
  for (std::size_t c = 0; c < sums.all.size(); ++c) met = met && std::abs(sums.all[c]) <= rounding[c];
  return met;
}

/// Branches whose ends the last step brought together stick; false if there are none.
bool ConvexNetwork::stick_where_met() {
  bool met = false;
  for (Branch& b : branches_) {
    if (!b.apart || b.stuck || b.w != 0) continue;
    b.apart = false;
    met = b.stuck = true;
  }
  return met;
}

/// Released branches that have not moved, as others hold their ends, stick: the force that decided at which bound they are may
/// no longer exist. False if there are none.
bool ConvexNetwork::stick_where_idle() {
  merge();
  bool idle = false;
  for (Branch& b : branches_) {
    if (!b.jumps || b.stuck || b.w != 0) continue;
    idle = b.stuck = true;
  }
  return idle;
}

/// Whether the forces at all free clusters sum to 0, but for the round-off of forces and values, and a negligible share of the largest force.
/// That a step gains nothing says less: the gain of small forces is hidden by that of large ones.
bool ConvexNetwork::answer_balances(Sums& sums) const {
  if (balanced(sums)) return true;
  const double negligible = numerics::answer_imbalance * largest_force() + numerics::underflowing_force;
  std::vector<double> allowed = sums.rounding;
  for (double& sum : allowed) sum += negligible;
  for (const Branch& b : branches_) {
    double blur = 0;
    for (const int node : {b.a, b.b}) blur += value_rounding * (std::abs(base_[at(node)]) + std::abs(u_[at(node)]));
    if (clusters_.joined(b.a, b.b) || blur == 0) continue;
    const double range = b.force(b.w + blur, 1) - b.force(b.w - blur, -1);
    for (const int node : {b.a, b.b}) {
      if (const int column = clusters_.column(node); column >= 0) allowed[at(column)] += range;
    }
  }
  for (std::size_t c = 0; c < allowed.size(); ++c) {
    if (!(std::abs(sums.all[c]) <= allowed[c])) return false;
  }
  return true;
}

/// Round-off of the slope along d.
double ConvexNetwork::roundoff_along(const std::vector<double>& d, const Sums& sums) const {
  double roundoff = 0;
  for (int k = 0; at(k) < u_.size(); ++k) {
    if (const int column = clusters_.column(k); column >= 0 && clusters_.head(k) == k) roundoff += sums.rounding[at(column)] * std::abs(d[at(k)]);
  }
  return roundoff;
}

ConvexNetwork::Outcome ConvexNetwork::solve() {
  const Outcome outcome = minimise();
  if (outcome != Outcome::solved) return outcome;
  merge();  // what sticks again since the last step
  Sums sums;
  return answer_balances(sums) ? outcome : Outcome::undecided;
}

ConvexNetwork::Outcome ConvexNetwork::minimise() {
  find_restrained();
  choose_weak();
  classify_equations();
  stick_at_first();
  for (Branch& b : branches_) b.w = nodal_difference(b);
  released_.clear();
  Sums sums;
  std::vector<double> d;
  int idle = 0;  // rounds in a row without gain
  double least = std::numeric_limits<double>::infinity();  // least magnitude of the descent since the last release
  int stagnant = 0;
  bool looked_again = false;  // since the last step
  int releases = 0;
  const std::size_t rounds = numerics::least_rounds + numerics::rounds_a_branch * branches_.size();
  for (rounds_ = 0; rounds_ < rounds; ++rounds_) {
    merge();
    while (stick_where_met()) merge();  // several may come together in one step
    if (rounds_ == 0) {
      let_prescribed_part();
      // Nodes that equations join need not have started together, but to round-off.
      for (Branch& b : branches_) {
        const double w = nodal_difference(b);
        if (std::abs(w - b.w) > difference_rounding * (std::abs(base_[at(b.a)]) + std::abs(base_[at(b.b)]))) b.w = w;
      }
      open_for_equations();
    }
    const bool no_gain = full_steps_ >= numerics::settled_newton_steps || idle >= numerics::settled_newton_steps;
    bool settled = no_gain ? answer_balances(sums) : balanced(sums);
    if (!settled) {
      if (!direction_of_descent(sums.laws, d, false)) {
        if (flattened(sums.all)) return Outcome::unbounded;
        if (!direction_of_descent(sums.laws, d, true)) return Outcome::undecided;
      }
      const double descent = slope_along(d, 0);
      if (!equations_.empty() && balanced(sums)) {
        // The forces of equations balance everything, and hold what was released: the step is their round-off.
        released_.clear();
        looked_again = false;
        settled = true;
      }
      if (!settled && !(descent < 0) && !released_.empty()) {
        // Branches released together hold each other back: release the worst alone. If it holds itself back, it was round-off.
        const bool alone = released_.size() == 1;
        for (std::size_t k = alone ? 0 : 1; k < released_.size(); ++k) branches_[at(released_[k])].stuck = true;
        if (alone && (looked_again || !stick_where_idle())) return equations_.empty() || bonds_hold() ? Outcome::solved : Outcome::undecided;
        looked_again = looked_again || alone;
        released_.resize(alone ? 0 : 1);
        continue;
      }
      settled = settled || (!(descent < 0) && answer_balances(sums));
      idle = -descent <= roundoff_along(d, sums) ? idle + 1 : 0;
      // Progress is measured by what Newton's step would gain: the imbalance may grow on the way.
      if (std::abs(descent) < least / 2) {
        least = std::abs(descent);
        stagnant = 0;
      } else if (++stagnant >= numerics::stagnant_rounds) {
        if (flattened(sums.all)) return Outcome::unbounded;
        settled = true;
      }
    }
    if (settled) {
      full_steps_ = idle = stagnant = 0;
      least = std::numeric_limits<double>::infinity();
      if (!release()) return run_away() ? Outcome::unbounded : in_doubt_ ? Outcome::undecided : Outcome::solved;
      if (++releases == numerics::single_releases) release_as_before();
      continue;
    }
    released_.clear();
    looked_again = false;
    for (Branch& b : branches_) b.apart = b.jumps && !b.stuck && b.w != 0;
    if (search(d, idle == 0) == Outcome::unbounded) {
      for (std::size_t k = 0; k < u_.size(); ++k) {
        if (d[k] != 0) runaways_.push_back(static_cast<int>(k));
      }
      return Outcome::unbounded;
    }
  }
  return Outcome::undecided;
}

}  // namespace rheonet
