#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"
#include "core/nonsmooth/conductances.hpp"

namespace rheonet {

/// Forces of least norm in the branches that stick: see stick_forces.cpp. Beside equations, bounds are wider by `roundoff`.
void ConvexNetwork::find_bond_forces(double roundoff) {
  bond_force_.assign(branches_.size(), 0);
  beyond_.clear();
  in_doubt_ = false;
  if (std::none_of(branches_.begin(), branches_.end(), [](const Branch& b) { return b.stuck; })) return;
  std::vector<double> left(u_.size(), 0);
  for (const Branch& b : branches_) {
    if (b.stuck) continue;
    const double f = b.force(b.w, b.side);
    left[at(b.a)] += f;
    left[at(b.b)] -= f;
  }
  const std::vector<std::size_t> open = equations_.empty() ? std::vector<std::size_t>{} : open_equations();
  for (std::size_t e = 0, k = 0; e < equations_.size(); ++e) {
    if (k < open.size() && open[k] == e) {
      ++k;
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) left[at(equations_[e].node[i])] += equations_[e].factor[i] * equations_[e].force;
  }
  std::vector<int> row(u_.size(), -1);
  int rows = 0;
  for (std::size_t k = 0; k < u_.size(); ++k) {
    left[k] += inertia_[k] * u_[k] - applied_[k];
    // Phi is 0 at fixed nodes, and at the heaviest node of each other cluster: the round-off of a balance stays there.
    const bool reference = clusters_.column(static_cast<int>(k)) >= 0 && clusters_.head(static_cast<int>(k)) == static_cast<int>(k);
    if (!fixed_[k] && !reference) row[k] = rows++;
  }
  Eigen::VectorXd phi(rows);  // the loads, then the potentials
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (row[k] >= 0) phi[row[k]] = -left[k];
  }
  if (!equations_.empty()) return share_with_open_equations(open, row, phi, roundoff);
  // Every cluster has its reference: nothing is left open.
  std::vector<Conductance> bonds;
  for (const Branch& b : branches_) {
    if (b.stuck) bonds.push_back({row[at(b.a)], row[at(b.b)], 1});
  }
  solve_conductances(bonds, phi);
  const auto potential = [&](int node) { return row[at(node)] < 0 ? 0 : phi[row[at(node)]]; };
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const Branch& b = branches_[k];
    if (!b.stuck) continue;
    const double f = bond_force_[k] = potential(b.a) - potential(b.b);
    const int side = f > b.law.high ? 1 : -1;
    const double bound = side > 0 ? b.law.high : b.law.low, over = side * (f - bound);
    if (over > numerics::balance_roundoff * std::abs(bound)) beyond_.push_back({over, static_cast<int>(k), side});
  }
}

double ConvexNetwork::largest_force() const {
  double largest = 0;
  for (std::size_t k = 0; k < u_.size(); ++k) largest = std::max({largest, std::abs(applied_[k]), std::abs(inertia_[k] * u_[k])});
  for (const Branch& b : branches_) largest = std::max(largest, b.stuck ? 0 : std::abs(b.force(b.w, b.side)));
  return largest;
}

/// True if the branches that stick can hold their forces, to the round-off of the largest of all forces.
bool ConvexNetwork::bonds_hold() {
  find_bond_forces(numerics::balance_roundoff * largest_force());
  return beyond_.empty() && !in_doubt_;
}

/// Releases the branches that cannot hold their forces, the worst first in `released_`; false if there are none.
bool ConvexNetwork::release() {
  find_bond_forces();
  std::sort(beyond_.begin(), beyond_.end(), [](const Beyond& p, const Beyond& q) { return std::pair(p.over, p.branch) > std::pair(q.over, q.branch); });
  released_.clear();
  for (const auto& [over, k, side] : beyond_) {
    branches_[at(k)].stuck = false;
    branches_[at(k)].side = side;
    released_.push_back(k);
  }
  return !beyond_.empty();
}

/// Releases all branches that slipped before. A branch that does not move sticks again, like any other branch.
void ConvexNetwork::release_as_before() {
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    Branch& b = branches_[k];
    if (!b.stuck || b.before == 0) continue;
    b.stuck = false;
    b.side = b.before;
    released_.push_back(static_cast<int>(k));
  }
}

/// True if nothing but regularising slopes holds some node.
bool ConvexNetwork::run_away() {
  double scale = 0;
  for (std::size_t k = 0; k < u_.size(); ++k) {
    scale = std::max({scale, std::abs(applied_[k]), std::abs(inertia_[k] * u_[k])});
  }
  for (const Branch& b : branches_) {
    for (double f : {b.law.low, b.law.high, b.force(b.w, b.side)}) {
      if (std::isfinite(f)) scale = std::max(scale, std::abs(f));
    }
  }
  // A node with inertia does not run away.
  std::vector<char> heavy(u_.size(), 0);
  double farthest = 0;
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (!restrained(k)) continue;
    heavy[clusters_.of(static_cast<int>(k))] = 1;
    farthest = std::max(farthest, std::abs(base_[k] + u_[k]));
  }
  for (const Branch& b : branches_) {
    if (b.stuck || std::abs(b.weak * b.w) <= numerics::regularising_load * scale) continue;
    // A node that goes with others does not run away either. Without any force, the regularising slope carries the largest share.
    if (std::abs(b.w) <= numerics::carried_along * farthest) continue;
    for (int node : {b.a, b.b}) {
      if (!heavy[clusters_.of(node)]) runaways_.push_back(node);
    }
  }
  return !runaways_.empty();
}

/// True if laws that reach a bound only in the limit have done so, and an imbalance remains.
bool ConvexNetwork::flattened(const std::vector<double>& sums) {
  // The parts of the network that remain when flat laws are cut: only bounds hold them.
  DisjointSets parts(u_.size());
  for (const Branch& b : branches_) {
    const double w = b.w;
    if (clusters_.joined(b.a, b.b) || b.slope(w) * std::abs(w) > numerics::runaway_imbalance * std::abs(b.force(w, b.side)) || w == 0) {
      parts.join(b.a, b.b);
    }
  }
  std::vector<double> left(u_.size(), 0), forces(left), flat(left);
  for (const Branch& b : branches_) {
    const std::size_t from = at(parts.find(b.a)), to = at(parts.find(b.b));
    if (from == to) continue;
    const double f = b.force(b.w, b.side);
    flat[from] += f;
    flat[to] -= f;
  }
  std::vector<char> held(u_.size(), 0);
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (restrained(k)) held[at(parts.find(static_cast<int>(k)))] = 1;
    forces[at(parts.find(static_cast<int>(k)))] += std::abs(applied_[k]);
    const int column = clusters_.column(static_cast<int>(k));
    if (column >= 0 && clusters_.head(static_cast<int>(k)) == static_cast<int>(k)) left[at(parts.find(static_cast<int>(k)))] += sums[at(column)];
  }
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const std::size_t part = at(parts.find(static_cast<int>(k)));
    // A lack of force counts, an excess does not: a step may have gone too far.
    const bool too_little = left[part] * flat[part] <= 0;
    if (!held[part] && too_little && std::abs(left[part]) > numerics::runaway_imbalance * forces[part]) runaways_.push_back(static_cast<int>(k));
  }
  return !runaways_.empty();
}

}  // namespace rheonet
