#include "core/netlist/curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

/// Lengths and slopes of the intervals between points.
struct Secants {
  std::vector<double> length, slope;

  Secants(const std::vector<double>& times, const std::vector<double>& values) {
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      length.push_back(times[i + 1] - times[i]);
      slope.push_back((values[i + 1] - values[i]) / length.back());
    }
  }

  /// At the outer end of interval `outer`, whose neighbour is `inner`.
  double rate_at_end(std::size_t outer, std::size_t inner) const {
    const double s = slope[outer], r = slope[inner];
    const double rate = ((2 * length[outer] + length[inner]) * s - length[outer] * r) / (length[outer] + length[inner]);
    if (!(rate * s > 0)) return 0;
    return s * r <= 0 && std::abs(rate) > 3 * std::abs(s) ? 3 * s : rate;
  }

  /// Rates at the points of the cubic spline with these rates at its ends. Solves a tridiagonal system by elimination.
  std::vector<double> spline_rates(double first, double last) const {
    const std::size_t n = length.size();
    std::vector<double> rate(n + 1, first), ratio(n + 1, 0);
    for (std::size_t i = 1; i < n; ++i) {
      const double a = length[i], c = length[i - 1], pivot = 2 * (a + c) - a * ratio[i - 1];
      ratio[i] = c / pivot;
      rate[i] = (3 * (a * slope[i - 1] + c * slope[i]) - a * rate[i - 1]) / pivot;
    }
    rate[n] = last;
    for (std::size_t i = n - 1; i > 0; --i) rate[i] -= ratio[i] * rate[i + 1];
    return rate;
  }

  /// `rate` between the intervals i - 1 and i, or the nearest one with which both are monotone.
  double monotone(double rate, std::size_t i) const {
    const double before = slope[i - 1], after = slope[i];
    if (!(before * after > 0)) return 0;
    const double most = 3 * std::min(std::abs(before), std::abs(after));
    return std::copysign(std::clamp(std::copysign(1.0, before) * rate, 0.0, most), before);
  }
};

}  // namespace

Curve::Curve(std::vector<double> times, std::vector<double> values) : times_(std::move(times)), values_(std::move(values)) {
  const Secants secants(times_, values_);
  const std::size_t n = times_.size();
  rates_.assign(n, secants.slope.front());
  if (n > 2) {
    rates_ = secants.spline_rates(secants.rate_at_end(0, 1), secants.rate_at_end(n - 2, n - 3));
    for (std::size_t i = 1; i + 1 < n; ++i) rates_[i] = secants.monotone(rates_[i], i);
  }
  areas_.assign(1, 0);
  areas_of_areas_.assign(1, 0);
  const auto enlarge = [](double& bound, double x) { bound = std::max(bound, std::abs(x)); };
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Cubic c = from_point(i);
    const double h = secants.length[i];
    areas_of_areas_.push_back(areas_of_areas_.back() + h * areas_.back() + twice(c, h));
    areas_.push_back(areas_.back() + h * (c.value + h * (c.rate / 2 + h * (c.square / 3 + h * c.cube / 4))));
    enlarge(largest_, values_[i]);
    enlarge(largest_, values_[i + 1]);
    // The rate of a cubic has its extremum within the interval or at an end of it.
    enlarge(largest_rate_, rates_[i]);
    enlarge(largest_rate_, rates_[i + 1]);
    const double top = -c.square / (3 * c.cube);
    if (top > 0 && top < h) enlarge(largest_rate_, c.rate + c.square * top);
    enlarge(largest_curvature_, 2 * c.square);
    enlarge(largest_curvature_, 2 * c.square + 6 * c.cube * h);
    enlarge(largest_third_, 6 * c.cube);
  }
}

Curve::Cubic Curve::from_point(std::size_t i) const {
  const double h = times_[i + 1] - times_[i], secant = (values_[i + 1] - values_[i]) / h;
  const double begins = rates_[i] - secant, ends = rates_[i + 1] - secant;
  // A curvature that is round-off would make a motion begin backwards.
  const double negligible = numerics::sum_ulps * std::numeric_limits<double>::epsilon() * (std::abs(rates_[i]) + std::abs(rates_[i + 1]) + std::abs(secant));
  const auto sum = [negligible](double x) { return std::abs(x) <= negligible ? 0 : x; };
  return {.number = i, .tau = 0, .value = values_[i], .rate = rates_[i], .square = -sum(2 * begins + ends) / h, .cube = sum(begins + ends) / h / h, .area = areas_[i], .area_of_area = areas_of_areas_[i]};
}

Curve::Cubic Curve::at(double t) const {
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, t);
  const auto i = static_cast<std::size_t>(next - times_.begin()) - 1;
  Cubic cubic = from_point(i);
  cubic.tau = t - times_[i];
  return cubic;
}

double Curve::value(double t) const {
  const Cubic c = at(t);
  return c.value + (c.rate + (c.square + c.cube * c.tau) * c.tau) * c.tau;
}

double Curve::rate(double t) const {
  const Cubic c = at(t);
  return c.rate + (2 * c.square + 3 * c.cube * c.tau) * c.tau;
}

double Curve::curvature(double t) const {
  const Cubic c = at(t);
  return 2 * c.square + 6 * c.cube * c.tau;
}

/// Integral of the area from the beginning of the interval, up to tau.
double Curve::twice(const Cubic& c, double tau) {
  return tau * tau * (c.value / 2 + tau * (c.rate / 6 + tau * (c.square / 12 + tau * c.cube / 20)));
}

double Curve::area_of_area(double from, double to) const {
  Cubic a = at(from);
  const Cubic b = at(to);
  if (a.number == b.number) {
    // Within one interval, without the cancellation of a difference of two sums.
    const double tau = a.tau;
    a.value += (a.rate + (a.square + a.cube * tau) * tau) * tau;
    a.rate += (2 * a.square + 3 * a.cube * tau) * tau;
    a.square += 3 * a.cube * tau;
    return twice(a, to - from);
  }
  const auto sum = [](const Cubic& c) { return c.area_of_area + c.tau * c.area + twice(c, c.tau); };
  return (sum(b) - sum(a)) - (to - from) * area(from);
}

double Curve::farthest_point(double a, double b) const {
  const double length = b - a, va = value(a), vb = value(b), ra = rate(a) * length, rb = rate(b) * length;
  double farthest = std::numeric_limits<double>::quiet_NaN(), most = -1;
  for (auto time = std::upper_bound(times_.begin(), times_.end(), a); time != times_.end() && *time < b; ++time) {
    const double x = (*time - a) / length, y = 1 - x;
    const double through_ends = y * y * (va * (1 + 2 * x) + ra * x) + x * x * (vb * (1 + 2 * y) - rb * y);
    const double off = std::abs(values_[static_cast<std::size_t>(time - times_.begin())] - through_ends);
    if (off > most) {
      most = off;
      farthest = *time;
    }
  }
  return farthest;
}

double Curve::area(double t) const {
  const Cubic c = at(t);
  return c.area + c.tau * (c.value + c.tau * (c.rate / 2 + c.tau * (c.square / 3 + c.tau * c.cube / 4)));
}

}  // namespace rheonet
