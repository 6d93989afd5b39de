#include "core/network/iwan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/numerics.hpp"

namespace rheonet {

/// The bundle after a reversal at p.
struct Iwan::Back {
  double p;
  Iwan bundle;
};

Iwan::Iwan(std::vector<Pair> pairs, double kink_share)
    : pairs_(std::move(pairs)),
      rest_(pairs_.size(), 0),
      slide_(rest_),
      kink_share_(kink_share),
      order_(pairs_.size()),
      rank_(pairs_.size()) {
  for (const Pair& pair : pairs_) {
    total_stiffness_ += pair.stiffness;
    total_force_ += pair.coulomb;
  }
  std::iota(order_.begin(), order_.end(), 0);
  begin(0, std::vector<double>(size(), 0), 1);
}

void Iwan::begin(double p, std::vector<double> forces, int direction) {
  f_ = std::move(forces);
  for (std::size_t i = 0; i < size(); ++i) f_[i] = std::clamp(f_[i], -pairs_[i].coulomb, pairs_[i].coulomb);
  go(p, direction);
}

void Iwan::begin_sliding(double p, int direction) {
  for (std::size_t i = 0; i < size(); ++i) f_[i] = direction * pairs_[i].coulomb;
  go(p, direction);
}

void Iwan::turn(double p) {
  remember(p);
  go(p, -s_);
}

/// Stores the forces and displacements of the pairs at p.
void Iwan::remember(double p) {
  for (std::size_t i = 0; i < size(); ++i) {
    slide_[i] = slide(i, p);
    f_[i] = pair_force(i, p);
  }
}

/// Starts at deflection p in `direction` with the forces f_.
void Iwan::go(double p, int direction) {
  s_ = direction;
  p_ref_ = p;
  ++branch_;
  back_.reset();
  put_in_order();
  sum_up();
  passed_ = static_cast<std::size_t>(std::upper_bound(y_.begin(), y_.end(), 0.0) - y_.begin());
  find_kink();
}

void Iwan::put_in_order() {
  const auto way = [&](std::size_t i) { return (pairs_[i].coulomb - s_ * f_[i]) / pairs_[i].stiffness; };
  y_.resize(size());
  for (std::size_t r = 0; r < size(); ++r) y_[r] = way(order_[r]);
  if (!std::is_sorted(y_.begin(), y_.end())) {
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) { return way(i) < way(j); });
    for (std::size_t r = 0; r < size(); ++r) y_[r] = way(order_[r]);
  }
  for (std::size_t r = 0; r < size(); ++r) rank_[order_[r]] = r;
}

void Iwan::sum_up() {
  sums_.assign(size() + 1, {});
  stiffness_back_ = 0;
  for (std::size_t r = 0; r < size(); ++r) {
    const auto [k, Fc] = pairs_[order_[r]];
    sums_[r + 1].bounds = sums_[r].bounds + Fc;
    sums_[r + 1].bound_energy = sums_[r].bound_energy + Fc * Fc / (2 * k);
    sums_[r + 1].lost = sums_[r].lost + Fc * y_[r];
  }
  // Sum each kind from its own end: no differences, so no cancellation.
  for (std::size_t r = size(); r-- > 0;) {
    const auto [k, Fc] = pairs_[order_[r]];
    const double f = s_ * f_[order_[r]];
    sums_[r].force = sums_[r + 1].force + f;
    sums_[r].stiffness = sums_[r + 1].stiffness + k;
    sums_[r].energy = sums_[r + 1].energy + f * f / (2 * k);
    if (f > -Fc) stiffness_back_ += k;
  }
}

/// Finds the next kink that is an event, after the yields already accepted.
void Iwan::find_kink() {
  next_end_ = passed_;
  while (next_end_ < size()) {
    next_ = next_end_;
    const double limit = y_[next_] * (1 + numerics::yield_point_distance) + numerics::yield_point_distance * std::abs(p_ref_);
    double stiffness = 0;
    for (; next_end_ < size() && y_[next_end_] <= limit; ++next_end_) {
      stiffness += pairs_[order_[next_end_]].stiffness;
    }
    if (stiffness > kink_share_ * total_stiffness_ || next_end_ == size()) return;
  }
  next_ = size();
}

void Iwan::stop_at_every_kink() {
  kink_share_ = 0;
  find_kink();
}

void Iwan::pass_kink(double p) {
  const std::size_t yielding = next_end_;
  if (travel(p) >= y_[yielding - 1]) {
    passed_ = yielding;
    find_kink();
    return;
  }
  remember(p);
  for (std::size_t rank = 0; rank < yielding; ++rank) {
    const std::size_t i = order_[rank];
    const double bound = s_ * pairs_[i].coulomb;
    slide_[i] -= (bound - f_[i]) / pairs_[i].stiffness;
    f_[i] = bound;
  }
  go(p, s_);
}

double Iwan::to_kink(double p) const {
  return next_ < size() ? y_[next_] - travel(p) : std::numeric_limits<double>::infinity();
}

std::size_t Iwan::yielded(double x, std::size_t limit) const {
  const std::size_t end = std::max(passed_, limit);
  // Force, energy and events are asked for at one place in turn.
  const bool again = found_ >= passed_ && found_ <= end && (found_ == passed_ || y_[found_ - 1] <= x) && (found_ == end || x < y_[found_]);
  if (again) return found_;
  const auto at = [&](std::size_t k) { return y_.begin() + static_cast<std::ptrdiff_t>(k); };
  return found_ = static_cast<std::size_t>(std::upper_bound(at(passed_), at(end), x) - y_.begin());
}

double Iwan::force(double p, double& slope) const {
  const double x = travel(p);
  const std::size_t m = yielded(x, next_);
  slope = sums_[m].stiffness;
  return force_at(x, m);
}

const Iwan& Iwan::turned(double p) const {
  if (!back_ || back_->p != p) {
    Back back{p, *this};
    back.bundle.turn(p);
    back_ = std::make_shared<const Back>(std::move(back));
  }
  return back_->bundle;
}

double Iwan::force_along(double p, double step, double& slope) const {
  if (step * s_ < 0) return turned(p).force_along(p, step, slope);
  const double x = travel(p) + std::abs(step);
  const std::size_t m = yielded(x, size());
  slope = sums_[m].stiffness;
  return force_at(x, m);
}

double Iwan::slope(double p, int direction) const {
  if (direction == s_) return sums_[yielded(p)].stiffness;
  return direction == 0 || travel(p) > 0 ? total_stiffness_ : stiffness_back_;
}

double Iwan::jump(double p, double jump) {
  if (jump == 0) return 0;
  if (jump * s_ < 0) turn(p);
  const double from = travel(p), to = from + std::abs(jump);
  const std::size_t before = yielded(from, size()), after = yielded(to, size());
  passed_ = after;
  find_kink();
  return heat_at(to, after) - heat_at(from, before);
}

double Iwan::stored_energy(double p) const {
  const double x = travel(p);
  const Sums& sums = sums_[yielded(x, next_)];
  return sums.bound_energy + sums.energy + x * (sums.force + x / 2 * sums.stiffness);
}

double Iwan::pair_force(std::size_t i, double p) const {
  const auto [k, Fc] = pairs_[i];
  return pair_yields(i, p) ? s_ * Fc : std::clamp(f_[i] + k * (p - p_ref_), -Fc, Fc);
}

void Iwan::place(std::size_t i, double rest, double slide) {
  rest_[i] = rest;
  slide_[i] = slide;
}

void Iwan::follow(double p, double displacement) {
  for (std::size_t i = 0; i < size(); ++i) slide_[i] += displacement - stretch(i, p) - slide(i, p);
}

double Iwan::slide(std::size_t i, double p) const {
  return pair_yields(i, p) ? slide_[i] + s_ * (travel(p) - y_[rank_[i]]) : slide_[i];
}

void IwanBatch::evaluate(const double* p, double* f, double* c) const {
  for (std::size_t i = 0; i < bundles_.size(); ++i) {
    double slope;
    f[i] = bundles_[i].force(p[i], slope);
    c[i] = 0;
  }
}

void IwanBatch::linearise(const double* p, double* f, double* df, double* c, double* dc) const {
  for (std::size_t i = 0; i < bundles_.size(); ++i) {
    f[i] = bundles_[i].force(p[i], df[i]);
    c[i] = dc[i] = 0;
  }
}

void IwanBatch::event_functions(std::size_t i, double p, double, double w, double dead_band, double* g) const {
  g[0] = bundles_[i].direction() * w + dead_band;  // reversal
  const double left = bundles_[i].to_kink(p);
  g[1] = std::isinf(left) ? 1 : left;
}

void IwanBatch::switch_memory(std::size_t i, int which, double p, double) {
  which == 0 ? bundles_[i].turn(p) : bundles_[i].pass_kink(p);
}

bool IwanBatch::set_direction(std::size_t i, double p, double, int direction) {
  if (direction == 0 || direction == bundles_[i].direction()) return false;
  bundles_[i].turn(p);
  return true;
}

double IwanBatch::settle(std::size_t i, double p, double, int direction) {
  bundles_[i].begin_sliding(p, direction);
  return p;
}

}  // namespace rheonet
