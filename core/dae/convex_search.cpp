// Newton's steps, and the line search along them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"
#include "core/dae/convex.hpp"
#include "core/nonsmooth/conductances.hpp"

namespace rheonet {

namespace {

constexpr double meeting_rounding = numerics::sum_ulps * std::numeric_limits<double>::epsilon();

}  // namespace

/// Newton's direction. With `secants`, laws that have become flat count by their secant from w = 0, or by their other slope.
bool ConvexNetwork::direction_of_descent(const std::vector<double>& sum_of_laws, std::vector<double>& d, bool secants) {
  std::vector<Conductance> slopes;
  for (const Branch& b : branches_) {
    const int a = clusters_.column(b.a), c = clusters_.column(b.b);
    if (clusters_.joined(b.a, b.b)) continue;
    const double w = b.w;
    double s = b.slope(w);
    if (secants) {
      if (w != 0) s = std::max(s, std::abs(b.force(w, b.side) / w));
      const double steeper = std::max(b.law.forward, b.law.backward);
      if (s <= numerics::flat_slope * steeper) s = steeper;
    }
    slopes.push_back({a, c, s});
  }
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const int column = clusters_.column(static_cast<int>(k));
    if (column >= 0 && inertia_[k] > 0) slopes.push_back({column, -1, inertia_[k]});
  }
  Eigen::VectorXd step = -Eigen::Map<const Eigen::VectorXd>(sum_of_laws.data(), clusters_.columns());
  if (!(equations_.empty() ? solve_conductances(slopes, step) : step_within_equations(slopes, step))) return false;
  d.assign(u_.size(), 0);
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const int column = clusters_.column(static_cast<int>(k));
    if (column >= 0) d[k] = step[column];
    if (!std::isfinite(d[k])) return false;
  }
  return true;
}

/// Derivative of the convex function along d, at x + step d and on the far side of jumps there.
double ConvexNetwork::slope_along(const std::vector<double>& d, double step) const {
  double sum = 0;
  for (const Branch& b : branches_) {
    const double dw = d[at(b.a)] - d[at(b.b)];
    if (dw == 0) continue;
    double w = b.w + step * dw;
    // The breakpoint of this branch itself, to round-off.
    if (std::abs(w) <= numerics::break_roundoff * std::abs(step * dw)) w = 0;
    sum += b.force(w, dw > 0 ? 1 : -1) * dw;
  }
  for (std::size_t k = 0; k < u_.size(); ++k) {
    if (d[k] != 0) sum += (inertia_[k] * (u_[k] + step * d[k]) - applied_[k]) * d[k];
  }
  // A direction keeps the equations but for its round-off, along which their forces would do work.
  for (const Equation& e : equations_) {
    for (std::size_t i = 0; i < e.node.size(); ++i) sum += e.force * e.factor[i] * d[at(e.node[i])];
  }
  return sum;
}

/// Moves along d to the minimum; a branch whose jump is at the minimum sticks from there on. `gains`: the slope along d exceeds round-off.
ConvexNetwork::Outcome ConvexNetwork::search(const std::vector<double>& d, bool gains) {
  struct Break { double step; int branch; };
  std::vector<Break> breaks;
  bool linear = true;  // and no kink on the way
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const Branch& b = branches_[k];
    const double w = b.w, dw = d[at(b.a)] - d[at(b.b)];
    linear = linear && !b.law.beyond && (b.law.forward == b.law.backward || w * (w + dw) > 0);
    if (b.jumps && w * dw < 0) breaks.push_back({-w / dw, static_cast<int>(k)});
  }
  std::sort(breaks.begin(), breaks.end(), [](const Break& p, const Break& q) { return p.step < q.step; });
  const auto first = std::partition_point(breaks.begin(), breaks.end(),
                                          [&](const Break& p) { return slope_along(d, p.step) < 0; });
  double low = first == breaks.begin() ? 0 : (first - 1)->step, high;
  const auto move = [&](double step) {
    for (std::size_t k = 0; k < u_.size(); ++k) u_[k] += step * d[k];
    for (Branch& b : branches_) {
      const double dw = step * (d[at(b.a)] - d[at(b.b)]), before = std::exchange(b.w, b.w + dw);
      if (std::abs(b.w) <= meeting_rounding * (std::abs(before) + std::abs(dw))) b.w = 0;
    }
  };
  // Where the round-off of large forces hides the slope, Newton's step still balances the nodes with small ones.
  if ((linear && breaks.empty()) || (!gains && (breaks.empty() || breaks.front().step > 1))) {
    move(1);
    ++full_steps_;
    return Outcome::solved;
  }
  full_steps_ = 0;
  if (first != breaks.end()) {
    high = first->step;
    // Slope before the jump: the slope beyond it says nothing of the interval.
    const double before = slope_along(d, high * (1 - numerics::distance_before_break));
    if (before < 0 || high == low) {
      move(high);
      branches_[at(first->branch)].stuck = true;
      return Outcome::solved;
    }
    high *= 1 - numerics::distance_before_break;
    // A distant breakpoint, where two ends move almost alike, is no good end of an interval.
    for (double near = std::max(1.0, 2 * low); high > numerics::distant_break * near; near *= 2) {
      if (!(slope_along(d, near) < 0)) high = near;
    }
  } else {
    for (high = std::max(1.0, 2 * low); slope_along(d, high) < 0; high *= 2) {
      // The last digits of a full step may be round-off.
      if (high == 1 && slope_along(d, 1) > -numerics::cancelling_slope * std::abs(slope_along(d, low))) break;
      if (high > numerics::unbounded_step) return Outcome::unbounded;
    }
  }
  // Search within one smooth interval: exact at once where all laws are linear.
  const double descent = -slope_along(d, 0);
  double slope_low = slope_along(d, low), slope_high = slope_along(d, high), step = high;
  for (int k = 0; k < numerics::line_search_sections && slope_high > 0; ++k) {
    const double secant = low + (high - low) * slope_low / (slope_low - slope_high);
    step = k % 3 == 2 || std::isinf(slope_high) ? (low + high) / 2 : std::min(std::max(secant, low), high);
    const double slope = slope_along(d, step);
    if (std::abs(slope) <= numerics::line_search_slope * descent || step == low || step == high) break;
    (slope < 0 ? low : high) = step;
    (slope < 0 ? slope_low : slope_high) = slope;
  }
  move(step);
  for (Branch& b : branches_) {
    if (b.w != 0 && d[at(b.a)] != d[at(b.b)]) b.side = b.w > 0 ? 1 : -1;
  }
  return Outcome::solved;
}

}  // namespace rheonet
