#include "tests/support/iwan_oscillator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace rheonet::test {

namespace {

using Real = long double;
constexpr int terms = 24;
// Short enough for the series: (omega h)^24/24! is nothing for omega h < 1.
constexpr Real longest_step = 0.01L;

Real polynomial(const Real* a, Real h) {
  Real sum = 0;
  for (int n = terms; n-- > 0;) sum = sum * h + a[n];
  return sum;
}

Real slope_of(const Real* a, Real h) {
  Real sum = 0;
  for (int n = terms; n-- > 1;) sum = sum * h + n * a[n];
  return sum;
}

/// The root of g, which rises from below 0 at 0 to above it at h.
template <class G>
Real root(G g, Real h) {
  Real low = 0, high = h;
  for (int k = 0; k < 200 && high - low > 1e-21L; ++k) {
    const Real gl = g(low), gh = g(high);
    Real middle = gh > gl ? low - gl * (high - low) / (gh - gl) : (low + high) / 2;
    if (k % 3 == 2 || !(middle > low && middle < high)) middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;
    (g(middle) < 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace

IwanOscillator::IwanOscillator(double mass, double force, double frequency, std::vector<Pair> pairs)
    : m_(mass), F_(force), omega_(2 * std::numbers::pi_v<Real> * frequency), pairs_(std::move(pairs)) {
  Real total = 0;
  for (const Pair& p : pairs_) {
    at_ref_.push_back(p.force);
    total += p.force;
  }
  // At rest without a drive yet: what pulls decides, else the drive that rises.
  s_ = total > 0 ? 1 : -1;
  turn();
}

/// From here on in the other direction.
void IwanOscillator::turn() {
  for (std::size_t i = 0; i < pairs_.size() && !y_.empty(); ++i) {
    if (slips(i)) history_.push_back({static_cast<double>(t_), i, 0, 0});
    at_ref_[i] = slips(i) ? Real(s_ * pairs_[i].coulomb) : at_ref_[i] + pairs_[i].stiffness * (x_ - x_ref_);
  }
  s_ = -s_;
  x_ref_ = x_;
  std::vector<Real> way;
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    way.push_back((pairs_[i].coulomb - s_ * at_ref_[i]) / pairs_[i].stiffness);
  order_.resize(pairs_.size());
  rank_.resize(pairs_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t i, std::size_t j) { return way[i] < way[j]; });
  y_.clear();
  stiffness_ = total_ = lost_ = 0;
  for (std::size_t r = 0; r < order_.size(); ++r) {
    rank_[order_[r]] = r;
    y_.push_back(way[order_[r]]);
    stiffness_ += pairs_[order_[r]].stiffness;
    total_ += at_ref_[order_[r]];
  }
  yielded_ = 0;
}

void IwanOscillator::series(Real* a) const {
  a[0] = x_;
  a[1] = v_;
  // sin(omega (t + h)) = sum of d_n h^n
  const Real sine = std::sin(omega_ * t_), cosine = std::cos(omega_ * t_);
  Real scale = 1;
  for (int n = 0; n + 2 < terms; ++n) {
    const Real cycle[] = {sine, cosine, -sine, -cosine};
    const Real drive = F_ * scale * cycle[n % 4];
    const Real held = n == 0 ? total_ : stiffness_ * a[n];
    a[n + 2] = (drive - held) / (m_ * (n + 1) * (n + 2));
    scale *= omega_ / (n + 1);
  }
}

void IwanOscillator::advance(double to) {
  Real a[terms];
  while (t_ < to) {
    series(a);
    const Real longest = std::min(longest_step, to - t_);
    Real h = longest;
    enum { nothing, yield, reversal } what = nothing;
    const auto back = [&](Real x) { return -s_ * slope_of(a, x); };
    if (back(h) > 0) {
      h = root(back, h);
      what = reversal;
    }
    if (yielded_ < y_.size()) {
      const auto beyond = [&](Real x) { return s_ * (polynomial(a, x) - x_ref_) - y_[yielded_]; };
      if (beyond(h) >= 0) {
        h = beyond(0) >= 0 ? 0 : root(beyond, h);
        what = yield;
      }
    }
    const Real before = x_;
    t_ = h == longest && longest < longest_step ? Real(to) : t_ + h;
    x_ = polynomial(a, h);
    v_ = slope_of(a, h);
    total_ += stiffness_ * (x_ - before);
    heat_ += lost_ * s_ * (x_ - before);
    if (what == yield) {
      const std::size_t i = order_[yielded_++];
      stiffness_ = yielded_ == y_.size() ? 0 : stiffness_ - pairs_[i].stiffness;
      lost_ += pairs_[i].coulomb;
      ++yields_;
      history_.push_back({static_cast<double>(t_), i, s_, static_cast<double>(v_)});
    } else if (what == reversal) {
      v_ = 0;
      turn();
    }
  }
}

double IwanOscillator::force(std::size_t i) const {
  return slips(i) ? s_ * pairs_[i].coulomb : static_cast<double>(at_ref_[i] + pairs_[i].stiffness * (x_ - x_ref_));
}

double IwanOscillator::dissipated() const { return static_cast<double>(heat_); }

}  // namespace rheonet::test
