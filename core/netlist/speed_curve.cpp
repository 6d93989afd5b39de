#include "core/netlist/speed_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

/// Speeds at which an expression begins to bend, found from outside. x^2 F''/F is constant for a power of x: a bend is where it changes
/// much within one step of the samples, or much more than in the step before.
std::vector<double> bends(const Characteristic& curve) {
  struct Sample { double x, force, slope; };
  std::vector<Sample> samples;
  for (const double x : Characteristic::samples()) {
    if (!(x > 0)) continue;
    double slope;
    const double force = curve.force(x, slope);
    if (std::isfinite(force) && std::isfinite(slope)) samples.push_back({x, force, slope});
  }
  std::vector<double> marks;
  double last = 0, last_change = 0;
  for (std::size_t i = samples.size(); i-- > 1;) {
    const Sample &in = samples[i - 1], &out = samples[i];
    const double force = std::max(std::abs(in.force), std::abs(out.force));
    const double bend = force > 0 ? in.x * out.x * (out.slope - in.slope) / (out.x - in.x) / force : 0;
    const double change = i + 1 == samples.size() ? 0 : std::abs(bend - last);
    const bool begins = change > numerics::least_bend && change > numerics::bend_growth * last_change;
    if (begins || change > numerics::plain_bend) marks.push_back(out.x);
    last = bend;
    last_change = change;
  }
  std::reverse(marks.begin(), marks.end());
  return marks;
}

}  // namespace

SpeedCurve::SpeedCurve(const Characteristic& curve, const Parameter& bounds)
    : curve_(curve), least_(bounds.lower), holds_(std::isfinite(bounds.upper)) {
  if (curve.expression()) {
    marks_ = bends(curve);
  } else if (curve.lines()) {
    marks_ = curve.lines()->ends();
  } else {
    marks_.assign(curve.points().begin() + 1, curve.points().end());
  }
  if (!curve.expression()) mark_end();
  own_ = marks_.empty() ? 0 : 1;
}

/// The end of the last line: its last point if the value there holds beyond it, else where it falls to the least value.
void SpeedCurve::mark_end() {
  const double last = curve_.points().back(), rate = curve_.last_slope(1);
  double slope;
  const double reach = holds_ ? 0 : (least_ - curve_.force(last, slope)) / rate;
  if ((holds_ && curve_.lines()) || (reach > 0 && std::isfinite(reach))) marks_.push_back(last + reach);
}

std::size_t SpeedCurve::switches() const { return own_ + (curve_.expression() ? curve_.expression()->switches() : 0); }

/// Rounded off at rest, where a curve may have a corner: the slider has an event there anyway.
double SpeedCurve::speed(double w) const {
  const double first = !marks_.empty() ? marks_.front() : curve_.expression() ? 1 : curve_.points().back();
  return std::hypot(w, numerics::rounded_rest * first);
}

std::size_t SpeedCurve::number_at(double x, std::span<const double> sides) const {
  if (own_ > 0 && !sides.empty() && !std::isnan(sides[0])) return static_cast<std::size_t>(sides[0]);
  return static_cast<std::size_t>(std::upper_bound(marks_.begin(), marks_.end(), x) - marks_.begin());
}

double SpeedCurve::along(double w, std::span<const double> sides, double& slope) const {
  const double x = speed(w), by_x = w / x;
  if (curve_.expression()) {
    const double force = curve_.force(x, slope, own(sides));
    slope *= by_x;
    return force;
  }
  if (holds_ && number_at(x, sides) == marks_.size()) {
    const double force = curve_.force(marks_.back(), slope);
    slope = 0;
    return force;
  }
  if (!curve_.lines()) {
    const double force = curve_.force(x, slope);
    slope *= by_x;
    return force;
  }
  const std::vector<Polyline::Line>& lines = curve_.lines()->lines();
  const Polyline::Line& line = lines[std::min(number_at(x, sides), lines.size() - 1)];
  slope = line.slope * by_x;
  return line.at(x);
}

std::optional<double> SpeedCurve::value(std::span<const double> arguments, std::span<const double> sides) const {
  double slope;
  const double force = along(arguments[1], sides, slope);
  return std::isfinite(force) ? std::optional(std::max(force, least_)) : std::nullopt;
}

std::optional<double> SpeedCurve::value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const {
  std::fill(partials.begin(), partials.end(), 0.0);
  double slope;
  const double force = along(arguments[1], sides, slope);
  if (!std::isfinite(force) || !std::isfinite(slope)) return {};
  if (force > least_) partials[1] = slope;
  return std::max(force, least_);
}

bool SpeedCurve::complete_sides(std::span<const double> arguments, std::span<double> sides) const {
  const double w = arguments[1];
  if (own_ > 0) sides[0] = static_cast<double>(number_at(speed(w), sides));
  return !std::isnan(w) && (!curve_.expression() || curve_.expression()->complete_sides(std::array{speed(w) / curve_.unit()}, sides.subspan(own_)));
}

bool SpeedCurve::cross(std::size_t k, std::span<const double> arguments, std::span<double> sides) const {
  const double w = arguments[1];
  if (k >= own_) return curve_.expression()->cross(k - own_, std::array{speed(w) / curve_.unit()}, sides.subspan(own_));
  const auto number = static_cast<std::size_t>(sides[0]);
  const double x = speed(w);
  const bool up = number == 0 || (number < marks_.size() && marks_[number] - x < x - marks_[number - 1]);
  sides[0] += up ? 1 : -1;
  return !std::isnan(w);
}

bool SpeedCurve::switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const {
  const double w = arguments[1];
  if (own_ > 0) {
    const double x = speed(w);
    const std::size_t number = number_at(x, sides);
    values[0] = std::numeric_limits<double>::infinity();
    if (number > 0) values[0] = x - marks_[number - 1];
    if (number < marks_.size()) values[0] = std::min(values[0], marks_[number] - x);
  }
  return !std::isnan(w) && (!curve_.expression() || curve_.expression()->switching_functions(std::array{speed(w) / curve_.unit()}, own(sides), values.subspan(own_)));
}

}  // namespace rheonet
