#include "tests/analytic/sliding_motion.hpp"

#include <algorithm>
#include <cmath>

namespace rheonet::test {

namespace {
// In a run, places where a change is looked for.
constexpr double looks = 40000;
}  // namespace

double first_crossing(const std::function<double(double)>& g, double longest, double step) {
  const double samples = std::ceil(longest / step);
  for (double n = 1; n <= samples; ++n) {
    double low = longest * (n - 1) / samples, high = longest * n / samples;
    if (!(g(low) < 0 && g(high) >= 0)) continue;
    for (int bisection = 0; bisection < 80; ++bisection) {
      const double middle = (low + high) / 2;
      (g(middle) < 0 ? low : high) = middle;
    }
    return high;
  }
  return longest;
}

std::function<Response(double t)> steady(double force) {
  return [=](double) { return Response::constant(force); };
}

SlidingMotion::Phase SlidingMotion::phase(const Body& body, double t, int s, const Response& force, double belt,
                                          double x, double v) {
  const auto& [m, k, c, Fc, Fs] = body;
  Phase result{t, s, {}, {}, {}};
  if (s == 0) {
    result.velocity = Response::constant(belt);
    result.position = result.velocity.integral(x);
    result.friction = force - k * result.position - Response::constant(c * belt);
    return result;
  }
  result.friction = Response::constant(s * Fc);
  const Response free = force - result.friction;
  if (k > 0) {
    const Response::Complex root = std::sqrt(Response::Complex(c * c - 4 * k * m));
    result.position = (free / k).second_order((c + root) / (2 * m), (c - root) / (2 * m), x, v);
    result.velocity = result.position.derivative();
  } else {
    result.velocity = c > 0 ? (free / c).lag(m / c, v) : (free / m).integral(v);
    result.position = result.velocity.integral(x);
  }
  return result;
}

SlidingMotion::SlidingMotion(const Body& body, const std::vector<Stage>& stages, double stop, double x, double v) {
  const auto sign = [](double a) { return a < 0 ? -1 : 1; };
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto& [start, force, belt] = stages[i];
    const double end = i + 1 < stages.size() ? stages[i + 1].start : stop;
    const auto needed = [&](double t) { return force(t)(0) - body.k * x - body.c * belt; };
    double t = start;
    int s = v != belt ? sign(v - belt) : std::abs(needed(t)) <= body.Fs ? 0 : sign(needed(t));
    if (i > 0) instants_.push_back(start);
    while (t < end) {
      const Phase next = phase(body, t, s, force(t), belt, x, v);
      const auto off = [&](double u) {
        return s == 0 ? std::abs(next.friction(u)) - body.Fs : s * (belt - next.velocity(u));
      };
      const double duration = first_crossing(off, end - t, stop / looks);
      phases_.push_back(next);
      x = next.position(duration);
      v = next.velocity(duration);
      const bool changed = duration < end - t;
      t = changed ? t + duration : end;
      if (!changed) continue;
      v = belt;
      s = s == 0 ? sign(next.friction(duration)) : std::abs(needed(t)) <= body.Fs ? 0 : sign(needed(t));
      changes_.push_back(t);
      instants_.push_back(t);
    }
  }
}

const SlidingMotion::Phase& SlidingMotion::phase(double t) const {
  std::size_t j = phases_.size() - 1;
  while (j > 0 && phases_[j].start > t) --j;
  return phases_[j];
}

double SlidingMotion::position(double t) const { return phase(t).position(t - phase(t).start); }
double SlidingMotion::velocity(double t) const { return phase(t).velocity(t - phase(t).start); }
double SlidingMotion::acceleration(double t) const { return phase(t).velocity.derivative()(t - phase(t).start); }
double SlidingMotion::friction(double t) const { return phase(t).friction(t - phase(t).start); }
bool SlidingMotion::sticks(double t) const { return phase(t).s == 0; }

}  // namespace rheonet::test
