#include "tests/support/reference_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace rheonet::test {

namespace {

constexpr std::array<const char*, 8> type_names = {"spring", "dashpot", "slider", "sfm", "vfm", "cfm", "freewheel", "stop"};

double sign_of(double x) { return x < 0 ? -1 : 1; }

}  // namespace

bool ReferenceLaw::is_law(const std::string& type) {
  return std::find(type_names.begin(), type_names.end(), type) != type_names.end();
}

ReferenceLaw::ReferenceLaw(const SceneElement& element, const Declaration& declaration, double displacement) {
  const auto found = std::find(type_names.begin(), type_names.end(), declaration.type);
  if (found == type_names.end()) throw std::runtime_error("no law: " + declaration.type);
  type_ = static_cast<Type>(found - type_names.begin());
  double rest = 0, f0 = not_given, d0 = not_given;
  for (std::size_t k = 0; k < declaration.parameters.size(); ++k) {
    const std::string& name = declaration.parameters[k].name;
    const double value = element.values[k];
    if (name == "stiffness") stiffness_ = value;
    if (name == "damping") damping_ = value;
    if (name == "coulomb") (type_ == Type::slider ? sliding_ : coulomb_) = value;
    if (name == "exponent" || name == "flow_index") exponent_ = value;
    if (name == "rest") rest = value;
    if (name == "lower" && !std::isnan(value)) lower_ = value;
    if (name == "upper" && !std::isnan(value)) upper_ = value;
    if (name == "f0") f0 = value;
    if (name == "d0") d0 = value;
    if (name == "stribeck") stribeck_ = value;
    if (name == "shape") shape_ = value;
  }
  if (type_ == Type::slider) bound(slider_bounds(element, [](const Signal& signal) { return signal.value(0); }));
  if (!std::isnan(f0)) force_ = f0;
  if (type_ == Type::stop) {
    stretch_ = std::isnan(d0) ? displacement : d0;
    force_ = contact(0, 1).force;
    piece_.direction = piece_.leaving = stretch_ > upper_ ? 1 : stretch_ < lower_ ? -1 : 0;
  }
  if (type_ == Type::spring) {
    stretch_ = !std::isnan(f0) ? f0 / stiffness_ : (std::isnan(d0) ? displacement : d0) - rest;
    force_ = stiffness_ * stretch_;
  }
}

// With u = 1 - s f/Fc: du/dx = -(sigma/Fc) u^i, x the distance travelled (thesis, Eqs. 8 to 11, 18).
ReferenceLaw::Value ReferenceLaw::solid_friction(double step) const {
  const double s = sign_of(step), q = 1 - exponent_, x = stiffness_ / coulomb_ * std::abs(step);
  const double before = std::max(0.0, 1 - s * force_ / coulomb_);
  double u = 0;
  if (exponent_ == 1) {
    u = before * std::exp(-x);
  } else if (exponent_ < 1) {
    u = std::pow(std::max(0.0, std::pow(before, q) - q * x), 1 / q);
  } else if (before > 0) {
    u = std::pow(std::pow(before, q) - q * x, 1 / q);
  }
  return {s * coulomb_ * (1 - u), u > 0 ? stiffness_ * std::pow(u, exponent_) : 0};
}

// The cfm at the end of the step, as u = 1 - s f/Fc. The displacement along its solid friction is step - h f/B, and the
// friction takes int du/u^i from u to `before` for it:  (Fc/sigma) int du/u^i + (h Fc/B) (1 - u) = s step.
// The left side falls with u, from above s step at u = 0 (or the bound is reached) to below it at u = 2.
double ReferenceLaw::relaxing(double step, double h, double s) const {
  const double before = std::max(0.0, 1 - s * force_ / coulomb_), q = 1 - exponent_;
  if (before == 0 && exponent_ >= 1) return 0;
  const double travel = coulomb_ / stiffness_, relaxed = h * coulomb_ / damping_;
  const double before_to_q = exponent_ == 1 ? 1 : std::pow(before, q);
  const auto excess = [&](double u, double u_to_q) {
    const double integral = exponent_ == 1 ? std::log(before / u) : (before_to_q - u_to_q) / q;
    return travel * integral + relaxed * (1 - u) - s * step;
  };
  if (exponent_ < 1 && excess(0, 0) <= 0) return 0;
  double low = 0, high = 2, u = std::clamp(before, 1e-3, 2.0);
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double u_to_q = exponent_ == 1 ? 1 : std::pow(u, q);
    const double e = excess(u, u_to_q), steepness = travel * u_to_q / u;
    if (std::abs(e) <= rounding * (std::abs(step) + (before + u) * steepness + relaxed)) return u;
    (e > 0 ? low : high) = u;
    const double next = u + e / (steepness + relaxed);
    if (next > low && next < high) {
      // Newton's method squares its error.
      if (std::abs(next - u) <= 1e-10 * u) return next;
      u = next;
    } else {
      u = (low + high) / 2;
      if (high - low <= 1e-16 * high) return u;
    }
  }
  return u;
}

ReferenceLaw::Value ReferenceLaw::stribeck(double step, double h) const {
  const double speed = std::abs(step) / h, above = StribeckCurve{sliding_, breakaway_, stribeck_, shape_}.above(speed);
  return {sign_of(step) * (sliding_ + above), speed > 0 ? -above * shape_ * std::pow(speed / stribeck_, shape_) / std::abs(step) : 0};
}

ReferenceLaw::Value ReferenceLaw::contact(double step, double h) const {
  const double d = stretch_ + step, x = d > upper_ ? d - upper_ : d < lower_ ? d - lower_ : 0;
  if (x == 0) return {0, 0};
  const double most = stiffness_ * std::abs(x), damped = damping_ * step / h;
  if (std::abs(damped) <= most) return {stiffness_ * x + damped, stiffness_ + damping_ / h};
  const bool pressing = damped * x > 0;
  return {pressing ? 2 * stiffness_ * x : 0, pressing ? 2 * stiffness_ : 0};
}

ReferenceLaw::Value ReferenceLaw::value(double step, double h) const {
  switch (type_) {
    case Type::spring:
      return {stiffness_ * (stretch_ + step), stiffness_};
    case Type::dashpot: {
      const double rate = std::abs(step) / h;
      if (exponent_ == 1) return {damping_ * step / h, damping_ / h};
      const double grown = std::pow(rate, exponent_);
      return {sign_of(step) * damping_ * grown, exponent_ * damping_ * (rate > 0 ? grown / rate : std::pow(rate, exponent_ - 1)) / h};
    }
    case Type::slider:
      if (!std::isnan(stribeck_)) return stribeck(step, h);
      if (step > 0) return {slip_ > 0 ? coulomb_ : breakaway_, 0};
      return {slip_ < 0 ? -coulomb_ : -breakaway_, 0};
    case Type::freewheel:
      return {step < 0 ? -INFINITY : 0, 0};
    case Type::stop:
      return contact(step, h);
    case Type::loss:
      return {step > 0 ? range_.high : range_.low, 0};
    case Type::sfm:
      return solid_friction(step);
    case Type::vfm: {
      const double divisor = 1 + stiffness_ * h / damping_;
      return {(force_ + stiffness_ * step) / divisor, stiffness_ / divisor};
    }
    case Type::cfm:
      break;
  }
  const double s = sign_of(step), u = relaxing(step, h, s);
  return {s * coulomb_ * (1 - u), u > 0 ? 1 / (std::pow(u, -exponent_) / stiffness_ + h / damping_) : 0};
}

ReferenceLaw::Interval ReferenceLaw::at_rest(double h) const {
  if (type_ == Type::slider) return {slip_ < 0 ? -coulomb_ : -breakaway_, slip_ > 0 ? coulomb_ : breakaway_};
  if (type_ == Type::freewheel) return {-INFINITY, 0};
  if (type_ == Type::loss) return range_;
  if (type_ == Type::cfm) return {-coulomb_ * (1 - relaxing(0, h, -1)), coulomb_ * (1 - relaxing(0, h, 1))};
  const double f = value(0, h).force;
  return {f, f};
}

double ReferenceLaw::preferred(double h) const {
  if (rigid()) return 0;
  if (type_ == Type::cfm) return force_ / (1 + stiffness_ * h / damping_);
  return value(0, h).force;
}

void ReferenceLaw::accept(double step, double force, double h) {
  stretch_ += step;
  force_ = force;
  if (type_ == Type::stop) {
    const int side = stretch_ > upper_ ? 1 : stretch_ < lower_ ? -1 : 0;
    piece_ = {side, side, false};
  }
  if (type_ == Type::spring || type_ == Type::dashpot || type_ == Type::vfm || type_ == Type::stop) return;
  const int sign = step > 0 ? 1 : step < 0 ? -1 : 0;
  if (type_ == Type::slider) slip_ = sign;
  // A displacement within round-off is not a turn; a slider that sticks does not move at all.
  const auto tells = [&](double way) { return rigid() || stiffness_ * std::abs(way) > 1e-10 * coulomb_; };
  const bool moves = step == 0 || tells(step);
  const int direction = moves ? sign : piece_.direction;
  const double velocity = step / h, leaving = velocity + (velocity - velocity_) * h / (h + h_);
  // A step with its turn in the middle ends near where it began, but not at rest.
  const bool turning = direction != 0 && direction == piece_.direction && direction * leaving < 0 && (moves || tells(leaving * h));
  piece_ = {direction, turning ? -direction : direction, !rigid() && std::abs(force) >= coulomb_};
  velocity_ = velocity;
  h_ = h;
}

double ReferenceLaw::typical_slope(double h) const {
  if (type_ == Type::dashpot) return damping_ / h;
  return stiffness_;
}

}  // namespace rheonet::test
