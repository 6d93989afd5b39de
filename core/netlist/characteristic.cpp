#include "core/netlist/characteristic.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The number between two of equal sign at which a test that fails at `out` and holds at `in` begins to hold, to the last digit.
template <class Holds>
double boundary(double out, double in, Holds holds) {
  while (true) {
    const double middle = out + (in - out) / 2;
    if (middle == out || middle == in) return in;
    (holds(middle) ? in : out) = middle;
  }
}

}  // namespace

Characteristic::Characteristic(std::vector<double> x, std::vector<double> force, bool smooth) : x_(x), force_(force), smooth_(smooth) {
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    if (!falls_at_ && force[i + 1] < force[i]) falls_at_ = x[i + 1];
    const Polyline::Line line{x[i], force[i], (force[i + 1] - force[i]) / (x[i + 1] - x[i])};
    i == 0 ? void(lines_.emplace(line, largest_of(force))) : lines_->append(x[i], line);
  }
  if (!smooth || lines_->ends().empty()) return;
  lines_.reset();
  curve_.emplace(std::move(x), std::move(force));
}

std::vector<double> Characteristic::samples() {
  std::vector<double> result{0};
  const int steps = static_cast<int>(std::log10(numerics::far_out)) * numerics::samples_per_decade;
  for (int k = -steps; k <= steps; ++k) {
    const double x = std::pow(10.0, static_cast<double>(k) / numerics::samples_per_decade);
    result.insert(result.begin(), -x);
    result.push_back(x);
  }
  std::sort(result.begin(), result.end());
  return result;
}

Characteristic::Characteristic(std::shared_ptr<const SwitchedFunction> expression, double by_x, double by_force)
    : expression_(std::move(expression)), by_x_(by_x), by_force_(by_force) {
  double before = -infinite, slope;
  for (const double x : samples()) {
    const double now = force(x, slope);
    if (!falls_at_ && now < before) falls_at_ = x;
    before = now;
  }
}

Characteristic Characteristic::scaled(double by_x, double by_force) const {
  if (expression_) return Characteristic(expression_, by_x_ * by_x, by_force_ * by_force);
  std::vector<double> x = x_, force = force_;
  for (double& one : x) one *= by_x;
  for (double& one : force) one *= by_force;
  return Characteristic(std::move(x), std::move(force), smooth_);
}

double Characteristic::force(double x, double& slope, std::span<const double> sides) const {
  if (expression_) {
    x /= by_x_;
    const std::optional<double> force = expression_->value({&x, 1}, sides, {&slope, 1});
    slope = force ? slope * (by_force_ / by_x_) : std::numeric_limits<double>::quiet_NaN();
    return force ? by_force_ * *force : std::numeric_limits<double>::quiet_NaN();
  }
  if (lines_) {
    const Polyline::Line& line = lines_->lines()[lines_->line_at(x)];
    slope = line.slope;
    return line.at(x);
  }
  const double inside = std::clamp(x, x_.front(), x_.back());
  slope = curve_->rate(inside);
  return curve_->value(inside) + slope * (x - inside);
}

double Characteristic::integral(double x) const {
  if (curve_) {
    const double inside = std::clamp(x, x_.front(), x_.back()), beyond = x - inside;
    return curve_->area(inside) + beyond * (curve_->value(inside) + curve_->rate(inside) * beyond / 2);
  }
  const std::vector<double>& corners = lines_->ends();
  double sum = 0, from = x_.front();
  for (std::size_t k = 0; k < lines_->lines().size(); ++k) {
    const double to = k < corners.size() ? std::min(corners[k], x) : x;
    if (k == 0 || to > from) sum += (to - from) * lines_->lines()[k].at(from + (to - from) / 2);
    if (to == x) break;
    from = to;
  }
  return sum;
}

double Characteristic::work(double x) const {
  if (!expression_) return integral(x) - integral(0);
  const auto force_at = [this](double at) {
    double slope;
    return force(at, slope);
  };
  double coarse = 0;
  for (int panels = 1; panels <= numerics::work_panels; panels *= 2) {
    double sum = 0;
    for (int k = 0; k < panels; ++k) sum += boost::math::quadrature::gauss<double, 15>::integrate(force_at, x * k / panels, x * (k + 1) / panels);
    if (panels > 1 && std::abs(sum - coarse) <= numerics::work_tolerance * std::abs(sum)) return sum;
    coarse = sum;
  }
  return coarse;
}

double Characteristic::where(double wanted) const {
  if (wanted == 0) return 0;
  const double side = wanted < 0 ? -1 : 1;
  const auto reached = [&](double x) {
    double slope;
    return side * force(x, slope) >= side * wanted;
  };
  double far = side;
  while (!reached(far)) {
    far *= 2;
    if (std::isinf(far)) return far;
  }
  while (far != 0 && reached(far / 2)) far /= 2;
  return boundary(far / 2, far, reached);
}

double Characteristic::last_slope(int side) const {
  double slope;
  force(side * numerics::far_out, slope);
  return slope;
}

}  // namespace rheonet
