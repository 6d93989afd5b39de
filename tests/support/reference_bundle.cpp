#include "tests/support/reference_bundle.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet::test {

using Type = ReferenceLaw::Type;

bool ReferenceBundle::steep() const {
  return std::any_of(members_.begin(), members_.end(), [](const Member& m) { return m.law.steep(); });
}

bool ReferenceBundle::set_valued() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const Member& m) { return m.law.rigid() || m.law.type() == Type::cfm; });
}

bool ReferenceBundle::relaxing() const {
  return std::any_of(members_.begin(), members_.end(), [](const Member& m) { return m.law.type() == Type::cfm; });
}

bool ReferenceBundle::could_slip_on(const ReferenceBundle& before) const {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const ReferenceLaw& law = members_[k].law;
    if (law.type() != Type::slider || law.breakaway() <= law.coulomb()) continue;
    const bool stopped = before.members_[k].law.slip() != 0 && law.slip() == 0;
    if (stopped && std::abs(law.force()) > (1 - 1e-4) * law.coulomb()) return true;
  }
  return false;
}

bool ReferenceBundle::ambiguous_at_rest() const {
  return std::count_if(members_.begin(), members_.end(),
                       [](const Member& m) { return m.law.rigid(); }) > 1;
}

double ReferenceBundle::typical_slope(double h) const {
  double sum = 0;
  for (const Member& m : members_) sum += m.law.typical_slope(h);
  return sum;
}

ReferenceBundle::Point ReferenceBundle::at(double step, double h) const {
  Point point{step, 0, 0};
  for (const Member& m : members_) {
    const ReferenceLaw::Value value = m.law.value(m.sign * step, h);
    point.force += m.sign * value.force;
    point.slope += value.slope;
  }
  return point;
}

ReferenceBundle::Interval ReferenceBundle::at_rest(double h) const {
  Interval sum{0, 0};
  for (const Member& m : members_) {
    const auto [low, high] = m.law.at_rest(h);
    sum.low += m.sign > 0 ? low : -high;
    sum.high += m.sign > 0 ? high : -low;
  }
  return sum;
}

double ReferenceBundle::preferred(double h) const {
  double sum = 0;
  for (const Member& m : members_) sum += m.sign * m.law.preferred(h);
  return sum;
}

ReferenceBundle::Point ReferenceBundle::with_spring(double total, double K, double preload, double h) const {
  const double y = preload + K * total;
  const Interval rest = at_rest(h);
  if (y >= rest.low && y <= rest.high) return {0, y, K};
  // force(step) + K step = y, a rising function of step; step lies between 0 and where the force were still that at 0.
  const double edge = y > rest.high ? rest.high : rest.low;
  double near = 0, far = (y - edge) / K, step = far;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Point p = at(step, h);
    const double excess = p.force + K * step - y;
    if (std::abs(excess) <= ReferenceLaw::rounding * (std::abs(y) + std::abs(p.force))) break;
    if ((excess > 0) == (far > 0)) {
      far = step;
    } else {
      near = step;
    }
    const double next = step - excess / (p.slope + K);
    if (std::min(near, far) <= next && next <= std::max(near, far)) {
      const bool last = std::abs(next - step) <= 1e-10 * std::abs(step);  // Newton's method squares its error
      step = next;
      if (last) break;
    } else {
      step = (near + far) / 2;
      if (std::abs(far - near) <= 1e-16 * std::abs(far)) break;
    }
  }
  const Point p = at(step, h);
  // The force of whichever is less stiff has less rounding.
  if (p.slope < K) return {step, p.force, K * p.slope / (K + p.slope)};
  return {step, y - K * step, std::isfinite(p.slope) ? K * p.slope / (K + p.slope) : K};
}

bool ReferenceBundle::follow_slips(double step) {
  bool changed = false;
  for (Member& m : members_) {
    if (m.law.type() != Type::slider) continue;
    const double s = m.sign * step;
    const int slip = s > 0 ? 1 : s < 0 ? -1 : 0;
    if (slip == m.law.slip()) continue;
    m.law.set_slip(slip);
    changed = true;
  }
  return changed;
}

void ReferenceBundle::accept(double step, double force, double h) {
  if (step == 0 && set_valued()) {
    share_at_rest(force, h);
    return;
  }
  for (Member& m : members_) {
    const double s = m.sign * step;
    m.law.accept(s, m.law.value(s, h).force, h);
  }
}

// At rest a cfm has its preferred force, with s = sgn 0 = 0, and the sliders take the remaining force with the least norm, within their
// bounds. The cfms must take the part that exceeds these bounds. Without a slider all cfms are at the same fraction between their two
// directions (Filippov: the same convex combination of the two vector fields for everything that changes with this velocity).
void ReferenceBundle::share_at_rest(double force, double h) {
  Interval relaxing{0, 0};
  double given = 0, preferred = 0;
  std::vector<Interval> rooms(members_.size(), {0, 0});  // what each that sticks can carry
  Interval stuck{0, 0};
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const Member& m = members_[k];
    const auto [low, high] = m.law.at_rest(h);
    if (m.law.rigid()) {
      rooms[k] = m.sign > 0 ? Interval{low, high} : Interval{-high, -low};
      stuck.low += rooms[k].low;
      stuck.high += rooms[k].high;
    } else if (m.law.type() == Type::cfm) {
      relaxing.low += m.sign > 0 ? low : -high;
      relaxing.high += m.sign > 0 ? high : -low;
      preferred += m.sign * m.law.preferred(h);
    } else {
      given += m.sign * m.law.preferred(h);
    }
  }
  // Where the motion is given nothing asks for a mixture: s = 0, as with sliders.
  const bool own = stuck.high > stuck.low || force == this->preferred(h);
  const double friction = std::clamp(force - given - preferred, stuck.low, stuck.high);
  std::vector<double> room;
  for (const Interval& r : rooms) room.push_back(friction < 0 ? -r.low : r.high);
  // The level up to which every slider is loaded, if it can be: the weakest are full.
  std::vector<double> weakest_first = room;
  std::sort(weakest_first.begin(), weakest_first.end());
  double level = 0, left = std::abs(friction);
  for (std::size_t k = 0; k < weakest_first.size(); ++k) {
    level = left / static_cast<double>(weakest_first.size() - k);
    if (level <= weakest_first[k]) break;
    left -= weakest_first[k];
  }
  const double combined = force - given - friction;
  const double width = relaxing.high - relaxing.low;
  const double up = width > 0 ? (combined - relaxing.low) / width : 0.5;
  const double bound = combined > preferred ? relaxing.high : relaxing.low;
  const double away = bound == preferred ? 0 : (combined - preferred) / (bound - preferred);
  for (std::size_t k = 0; k < members_.size(); ++k) {
    Member& m = members_[k];
    const auto [low, high] = m.law.at_rest(h);
    const double from = m.sign > 0 ? low : high, to = m.sign > 0 ? high : low;
    double f = m.law.preferred(h);
    if (m.law.rigid()) {
      f = m.sign * std::copysign(std::min(room[k], level), friction);
    } else if (m.law.type() == Type::cfm) {
      f = own ? f + away * ((combined > preferred ? to : from) - f) : from + up * (to - from);
    }
    m.law.accept(0, f, h);
  }
}

}  // namespace rheonet::test
