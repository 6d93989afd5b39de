#include "core/solve/missed_events.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

MissedEvents::MissedEvents(Dae& dae, NetworkEvents& events) : dae_(dae), events_(events) {
  for (std::size_t k = events.first_of_bounds_and_limits(); k < static_cast<std::size_t>(events.count()); ++k) {
    const auto [branch, which] = events[k];
    if (which == NetworkEvents::of_slider && events.slips_between_firm(branch)) slipping_.push_back({branch, k, 0, false});
  }
}

void MissedEvents::begin(double t, const double* y, const double* yp) {
  right_time_ = not_looked;
  watched_ = events_.may_return();
  if (slipping_.empty()) return;
  const Dae::View& view = dae_.view(t, y, yp);
  for (Slipping& one : slipping_) one.slope = events_.slip_acceleration(one.slider, view);
}

double MissedEvents::at_time(const Integrator& integrator, double t, std::size_t event) {
  integrator.interpolate(t, 0, step_y_);
  integrator.interpolate(t, 1, step_yp_);
  return events_.guard(event, events_.seen_between(t, step_y_.data(), step_yp_.data()));
}

void MissedEvents::all_at(const Dae::View& view, std::vector<double>& g) const {
  g.resize(watched_.size());
  for (std::size_t i = 0; i < g.size(); ++i) g[i] = events_.guard(watched_[i], view);
}

void MissedEvents::look_at_step(const Integrator& integrator, double a, double b) {
  const auto look = [&](double t, std::vector<double>& g) {
    integrator.interpolate(t, 0, step_y_);
    integrator.interpolate(t, 1, step_yp_);
    all_at(events_.seen_between(t, step_y_.data(), step_yp_.data()), g);
  };
  // The guards at the end of the previous step are known.
  if (right_time_ == a)
    left_.swap(right_);
  else
    look(a, left_);
  // First: the view of the end is the present one.
  all_at(events_.seen_at_end(b, integrator.y().data(), integrator.yp().data()), right_);
  right_time_ = b;
  look((a + b) / 2, middle_);
}

/// Finds the slipping sliders whose speed had a minimum within the step, where they may have stopped. True if any.
bool MissedEvents::any_dips(const Dae::View& end) {
  bool any = false;
  for (Slipping& one : slipping_) {
    const double now = events_.slip_acceleration(one.slider, end);
    one.dips = one.slope < 0 && now > 0;
    one.slope = now;
    any = any || one.dips;
  }
  return any;
}

double MissedEvents::crossing(const Integrator& integrator, double positive, double negative, std::size_t event) {
  const double last_digit = numerics::last_digit_ulps * std::numeric_limits<double>::epsilon() * (std::abs(negative) + (negative - positive));
  while (negative - positive > last_digit) {
    const double half = (positive + negative) / 2;
    if (half <= positive || half >= negative) break;
    (at_time(integrator, half, event) > 0 ? positive : negative) = half;
  }
  return negative;
}

std::optional<MissedEvents::Missed> MissedEvents::find(const Integrator& integrator, const Dae::View& end, const std::vector<double>& hidden) {
  const double a = integrator.previous_time(), b = integrator.time();
  std::optional<Missed> first;
  if (!(b > a)) return first;
  const bool dips = any_dips(end);
  if (!dips && !events_.sticks()) return first;
  std::vector<char> dipping(watched_.size(), 0);
  for (const Slipping& one : slipping_) dipping[one.event - events_.first_of_bounds_and_limits()] = one.dips;
  look_at_step(integrator, a, b);
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    if (events_.slips(watched_[i]) && !dipping[i]) continue;
    double left = a, middle = (a + b) / 2, right = b;
    double gl = left_[i], gm = middle_[i], gr = right_[i];
    const double steep = std::max({gl, gm, gr}) - std::min({gl, gm, gr});
    for (int n = 0; n < numerics::missed_event_refinements && gm > 0; ++n) {
      // The vertex of the parabola through the three points.
      const double p = (middle - left) * (gm - gr), q = (middle - right) * (gm - gl);
      const double least = middle - ((middle - left) * p - (middle - right) * q) / (2 * (p - q));
      if (!(least > left && least < right) || least == middle || std::min({gl, gm, gr}) > numerics::missed_event_dip * (1 + n) * steep + gm / 2) break;
      const double g = at_time(integrator, least, watched_[i]);
      if (g >= gm) break;
      (least < middle ? right : left) = middle;
      (least < middle ? gr : gl) = gm;
      middle = least;
      gm = g;
    }
    if (!(gm < 0) || !(gl > 0)) continue;
    middle = crossing(integrator, left, middle, watched_[i]);
    if (!first || middle < first->t) first = Missed{middle, static_cast<int>(watched_[i])};
  }
  std::vector<double> g;
  for (const double t : hidden) {
    if (first && t >= first->t) break;
    integrator.interpolate(t, 0, step_y_);
    integrator.interpolate(t, 1, step_yp_);
    all_at(events_.seen_between(t, step_y_.data(), step_yp_.data()), g);
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      if (!(g[i] < 0) || !(left_[i] > 0)) continue;
      const double crossed = crossing(integrator, a, t, watched_[i]);
      if (!first || crossed < first->t) first = Missed{crossed, static_cast<int>(watched_[i])};
    }
  }
  dae_.view(b, integrator.y().data(), integrator.yp().data());
  return first;
}

}  // namespace rheonet
