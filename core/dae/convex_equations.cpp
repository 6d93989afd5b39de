// Equations between the nodes of a convex problem: those of trains.
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"
#include "core/nonsmooth/conductances.hpp"
#include "core/nonsmooth/least_norm.hpp"

namespace rheonet {

namespace {

/// Solves [ L  C' ; C  0 ] [ x ; f ] = [ x ; given ] with the conductances L and the equations C. An equation without factors has f = 0.
/// Unknowns and equations are scaled, L to a diagonal of 1: conductances may be 20 decades apart.
bool solve_with_equations(const std::vector<Conductance>& conductances, const std::vector<std::vector<double>>& rows, const Eigen::VectorXd& given,
                          Eigen::VectorXd& x, Eigen::VectorXd& forces) {
  const Eigen::Index columns = x.size(), size = columns + given.size();
  if (size == 0) return true;
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(size);
  for (const auto& [a, b, value] : conductances) {
    for (const int i : {a, b}) {
      if (i >= 0) scale[i] += value;
    }
  }
  for (Eigen::Index i = 0; i < columns; ++i) scale[i] = scale[i] > 0 ? 1 / std::sqrt(scale[i]) : 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [a, b, value] : conductances) {
    for (const int i : {a, b}) {
      if (i >= 0) entries.emplace_back(i, i, value * scale[i] * scale[i]);
    }
    if (a < 0 || b < 0) continue;
    entries.emplace_back(a, b, -value * scale[a] * scale[b]);
    entries.emplace_back(b, a, -value * scale[a] * scale[b]);
  }
  for (std::size_t e = 0; e < rows.size(); ++e) {
    const int row = static_cast<int>(columns + static_cast<Eigen::Index>(e));
    double largest = 0;
    for (std::size_t c = 0; c < rows[e].size(); ++c) largest = std::max(largest, std::abs(rows[e][c] * scale[static_cast<Eigen::Index>(c)]));
    scale[row] = largest > 0 ? 1 / largest : 1;
    if (largest == 0) entries.emplace_back(row, row, 1);
    for (std::size_t c = 0; c < rows[e].size(); ++c) {
      if (rows[e][c] == 0) continue;
      const double factor = rows[e][c] * scale[static_cast<Eigen::Index>(c)] * scale[row];
      entries.emplace_back(row, static_cast<int>(c), factor);
      entries.emplace_back(static_cast<int>(c), row, factor);
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) return false;
  Eigen::VectorXd right(size);
  right << x, given;
  right = scale.cwiseProduct(right).eval();
  Eigen::VectorXd solved = factors.solve(right);
  // Refined (Skeel 1980), every equation holds to the round-off of its own terms, however small they are beside those of others.
  for (int k = 0; k < numerics::refinements; ++k) solved += factors.solve((right - matrix * solved).eval());
  solved = scale.cwiseProduct(solved).eval();
  x = solved.head(columns);
  forces = solved.tail(given.size());
  return true;
}

}  // namespace

void ConvexNetwork::tie(const std::array<int, 3>& nodes, const std::array<double, 3>& factors, double given) {
  equations_.push_back({nodes, factors, given});
  for (const int node : nodes) tied_[at(node)] = 1;
}

std::vector<double> ConvexNetwork::forces_of_equations() const {
  std::vector<double> forces;
  for (const Equation& e : equations_) forces.push_back(e.force);
  return forces;
}

/// The factors of the columns in each equation. `left`: of each equation, the change of velocity [m/s] that it still asks for. An equation whose nodes sticking branches hold, or that
/// follows from others, has no factors.
std::vector<std::vector<double>> ConvexNetwork::equations_of_columns(Eigen::VectorXd& left) const {
  std::vector<std::vector<double>> rows, reduced;
  left = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(equations_.size()));
  std::vector<std::size_t> pivots;
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    std::vector<double> row(at(clusters_.columns()), 0);
    double largest = 0, changed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int node = equations_[e].node[i], column = clusters_.column(node);
      const double factor = equations_[e].factor[i];
      largest = std::max(largest, std::abs(factor));
      changed += factor * change(node);
      if (column >= 0) row[at(column)] += factor;
    }
    std::vector<double> own = row;
    for (std::size_t k = 0; k < reduced.size(); ++k) {
      const double times = own[pivots[k]] / reduced[k][pivots[k]];
      for (std::size_t c = 0; times != 0 && c < own.size(); ++c) own[c] -= times * reduced[k][c];
    }
    const auto pivot = std::max_element(own.begin(), own.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
    if (pivot == own.end() || std::abs(*pivot) <= numerics::equal_given_values * largest) {
      row.assign(row.size(), 0);
    } else {
      left[static_cast<Eigen::Index>(e)] = equations_[e].given - changed;
      pivots.push_back(static_cast<std::size_t>(pivot - own.begin()));
      reduced.push_back(std::move(own));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Newton's step and the forces of the equations, from the sums of the laws' forces alone: added to earlier forces of equations, small ones
/// would be their round-off. `step` holds minus these sums, then the step.
bool ConvexNetwork::step_within_equations(const std::vector<Conductance>& slopes, Eigen::VectorXd& step) {
  Eigen::VectorXd left, forces;
  const std::vector<std::vector<double>> rows = equations_of_columns(left);
  if (!solve_with_equations(slopes, rows, left, step, forces)) return false;
  for (std::size_t e = 0; e < equations_.size(); ++e) equations_[e].force = forces[static_cast<Eigen::Index>(e)];
  return true;
}

/// Equations without factors, see `equations_of_columns`: their forces do not follow from the motion.
std::vector<char> ConvexNetwork::dependent_equations() const {
  Eigen::VectorXd left;
  std::vector<char> result;
  for (const std::vector<double>& row : equations_of_columns(left)) result.push_back(std::all_of(row.begin(), row.end(), [](double factor) { return factor == 0; }));
  return result;
}

/// Equations whose forces are open: dependent ones, and all that equations and bonds join to them.
std::vector<std::size_t> ConvexNetwork::open_equations() const {
  DisjointSets sets(u_.size());
  std::vector<int> place;  // of each equation: a node that is not prescribed, or any
  for (const Equation& e : equations_) {
    int first = -1;
    for (const int node : e.node) {
      if (fixed_[at(node)]) continue;
      if (first >= 0) sets.join(first, node);
      first = node;
    }
    place.push_back(first >= 0 ? first : e.node[0]);
  }
  for (const Branch& b : branches_) {
    if (b.stuck && !fixed_[at(b.a)] && !fixed_[at(b.b)]) sets.join(b.a, b.b);
  }
  const std::vector<char> dependent = dependent_equations();
  std::vector<char> open(u_.size(), 0);
  for (std::size_t e = 0; e < equations_.size(); ++e) open[at(sets.find(place[e]))] |= dependent[e];
  std::vector<std::size_t> result;
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    if (open[at(sets.find(place[e]))]) result.push_back(e);
  }
  return result;
}

/// Forces of least norm within the bounds, of the bonds and of open equations, which take any force. `row`: of each node, its place in
/// `load`, or -1. Where nothing within the bounds balances the loads, the bonds that contradict them are beyond theirs: if these open, the
/// nodes can move in a direction in which the loads outweigh all bounds.
void ConvexNetwork::share_with_open_equations(const std::vector<std::size_t>& open, const std::vector<int>& row, const Eigen::VectorXd& load, double roundoff) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> bonds;
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    if (branches_[k].stuck) bonds.push_back(k);
  }
  LeastNorm problem;
  const Eigen::Index balances = load.size(), forces = static_cast<Eigen::Index>(bonds.size() + open.size());
  problem.balance.setZero(balances + clusters_.columns(), forces);
  const auto act = [&](int node, Eigen::Index column, double factor) {
    if (row[at(node)] >= 0) problem.balance(row[at(node)], column) += factor;
  };
  // Counted from the least force within the bounds, which then contain 0.
  std::vector<double> least;
  Eigen::VectorXd left = Eigen::VectorXd::Zero(problem.balance.rows());
  left.head(balances) = load;
  Eigen::Index column = 0;
  for (const std::size_t k : bonds) {
    const Branch& b = branches_[k];
    act(b.a, column, 1);
    act(b.b, column, -1);
    least.push_back(std::clamp(0.0, b.law.low, b.law.high));
    left -= least.back() * problem.balance.col(column++);
    problem.low.push_back(b.law.low - roundoff - least.back());
    problem.high.push_back(b.law.high + roundoff - least.back());
  }
  for (const std::size_t e : open) {
    for (std::size_t i = 0; i < equations_[e].node.size(); ++i) {
      const int node = equations_[e].node[i], moving = clusters_.column(node);
      act(node, column, equations_[e].factor[i]);
      // On each cluster that moves, all of them together act as they do in the motion.
      if (moving < 0) continue;
      problem.balance(balances + moving, column) += equations_[e].factor[i];
      left[balances + moving] += equations_[e].factor[i] * equations_[e].force;
    }
    ++column;
    problem.low.push_back(-unlimited);
    problem.high.push_back(unlimited);
  }
  std::vector<double> force;
  std::vector<LeastNorm::Bound> contradiction;
  in_doubt_ = !problem.solve_within({left.begin(), left.end()}, force, contradiction);
  if (in_doubt_) return;
  for (const LeastNorm::Bound& bound : contradiction) beyond_.push_back({bound.share, static_cast<int>(bonds[bound.force]), bound.side});
  for (std::size_t i = 0; i < bonds.size(); ++i) bond_force_[bonds[i]] = least[i] + force[i];
  for (std::size_t i = 0; i < open.size(); ++i) equations_[open[i]].force = force[bonds.size() + i];
}

void ConvexNetwork::join_by_equations(DisjointSets& sets) const {
  std::vector<char> given(u_.size(), 0), still(given);  // of each set
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const std::size_t set = at(sets.find(static_cast<int>(k)));
    given[set] |= fixed_[k];
    still[set] |= fixed_[k] && origin_[k] + given_[k] == 0;
  }
  for (bool again = true; again;) {
    again = false;
    for (const Equation& e : equations_) {
      for (std::size_t i = 0; e.homogeneous && i < e.node.size(); ++i) {
        const int last = sets.find(e.node[i]), one = sets.find(e.node[(i + 1) % 3]), other = sets.find(e.node[(i + 2) % 3]);
        if (one != other || last == one || !(e.equal || still[at(one)]) || (given[at(last)] && given[at(one)])) continue;
        sets.join(last, one);
        given[at(one)] |= given[at(last)];
        still[at(one)] |= still[at(last)];
        again = true;
      }
    }
  }
}

/// Which equations permit equal values, and which hold for the values as they do for the changes: see `join_by_equations`.
/// To round-off: nodes that were joined across more would jump, and over a short time the inertia of that jump outweighs all forces.
void ConvexNetwork::classify_equations() {
  for (Equation& e : equations_) {
    double sum = 0, size = 0, left = e.given, magnitude = std::abs(left);
    for (std::size_t i = 0; i < e.node.size(); ++i) {
      const double value = e.factor[i] * origin_[at(e.node[i])];
      sum += e.factor[i];
      size += std::abs(e.factor[i]);
      left += value;
      magnitude += std::abs(value);
    }
    e.equal = std::abs(sum) <= numerics::equal_given_values * size;
    e.homogeneous = std::abs(left) <= numerics::equal_velocities * magnitude;
  }
}

/// Brings the start values to where the equations hold, by the least change that the inertias allow. Later steps keep them.
/// Branches that would thereby move as their laws forbid stick.
void ConvexNetwork::meet_equations() {
  for (bool again = !equations_.empty(); again;) {
    again = false;
    Eigen::VectorXd left;
    equations_of_columns(left);
    if (left.isZero(0)) return;
    std::vector<double> d;
    if (!direction_of_descent(std::vector<double>(at(clusters_.columns()), 0), d, false)) return;
    for (std::size_t k = 0; k < u_.size(); ++k) u_[k] += d[k];
    for (Equation& e : equations_) e.force = 0;
    for (Branch& b : branches_) {
      b.w = nodal_difference(b);
      if (b.stuck || b.w == 0 || !b.law.forbids(b.w)) continue;
      again = b.stuck = true;
    }
    if (again) merge();
  }
}

}  // namespace rheonet
