// Brakes and clutches: sliders whose sliding or normal force varies in time, or follows from the network.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::brake_test {

namespace {

/// Straight stretches of a signal: (time, value), with two points at one time where it jumps.
using Points = std::vector<std::pair<double, double>>;

std::string table(const Points& points, double factor = 1) {
  std::string text;
  for (const auto& [t, value] : points) text += fmt::format("[{:.17g}, {:.17g}], ", t, factor * value);
  return "{ table = [" + text + "] }";
}

/// The same signal where values below 0 count as 0.
Points positive_part(const Points& points) {
  Points result;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0 && points[k].second * points[k - 1].second < 0) {
      const auto& [t0, y0] = points[k - 1];
      const auto& [t1, y1] = points[k];
      result.emplace_back(t0 + (t1 - t0) * y0 / (y0 - y1), 0);
    }
    result.emplace_back(points[k].first, std::max(0.0, points[k].second));
  }
  return result;
}

/// Value of such a signal, just after a jump.
double value(const Points& points, double t) {
  if (t >= points.back().first) return points.back().second;
  std::size_t k = 0;
  while (points[k + 1].first <= t) ++k;
  const auto& [t0, y0] = points[k];
  const auto& [t1, y1] = points[k + 1];
  return y0 + (y1 - y0) * (t - t0) / (t1 - t0);
}

/// A motion in stretches of constant jerk.
class Stretches {
 public:
  Stretches(double x0, double v0) : parts_{{0, x0, v0, 0, 0}} {}

  /// From t on the acceleration is a + j (time since t).
  void accelerate(double t, double a, double j = 0) { parts_.push_back({t, position(t), velocity(t), a, j}); }
  void rest(double t) { parts_.push_back({t, position(t), 0, 0, 0}); }
  /// First time after t at which the velocity is 0 if it goes on like this.
  double stop_after(double t) const {
    const Part& p = at(t);
    const double u = t - p.t, v = p.v + p.a * u + p.j * u * u / 2, a = p.a + p.j * u;
    // v + a u + j u^2/2 = 0, without loss of digits.
    const double root = std::sqrt(std::max(0.0, a * a - 2 * p.j * v)), q = -(a + std::copysign(root, a));
    double first = HUGE_VAL;
    for (const double x : {q / p.j, 2 * v / q}) {
      if (x > 0 && x < first) first = x;
    }
    return t + first;
  }

  double position(double t) const {
    const Part& p = at(t);
    const double u = t - p.t;
    return p.x + u * (p.v + u * (p.a / 2 + u * p.j / 6));
  }
  double velocity(double t) const {
    const Part& p = at(t);
    const double u = t - p.t;
    return p.v + u * (p.a + u * p.j / 2);
  }
  double acceleration(double t) const { return at(t).a + at(t).j * (t - at(t).t); }

 private:
  struct Part { double t, x, v, a, j; };
  const Part& at(double t) const {
    std::size_t k = parts_.size() - 1;
    while (k > 0 && parts_[k].t > t) --k;
    return parts_[k];
  }
  std::vector<Part> parts_;
};

constexpr double m = 1.73, mu = 0.37, stop = 2.31;

/// A mass on a brake, pushed by a constant force; in rotation the same numbers are an inertia and torques.
std::string braked(const std::string& brake, double v0, double push = 0, bool rotation = false, const std::string& end = "") {
  return fmt::format(R"({}
[elements]
m1    = {{ type = "{}", at = "a", {} = {:.17g} }}
push  = {{ type = "{}", at = "a", {} = {:.17g} }}
brake = {{ type = "slider", between = ["a", "ground"], {} }}
[nodes]
a = {{ position = 0.2, velocity = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 231 }}
{})",
                     rotation ? "domain = \"rotation\"" : "", rotation ? "inertia" : "mass", rotation ? "inertia" : "mass", m,
                     rotation ? "torque" : "force", rotation ? "torque" : "force", push, brake, v0, stop, end);
}

std::string normal(const std::string& signal, const std::string& more = "") {
  return fmt::format("coulomb = {:.17g}, normal = {}{}", mu, signal, more);
}

std::string ramp(double rate, double offset = 0) { return fmt::format("{{ ramp = {:.17g}, offset = {:.17g} }}", rate, offset); }

void check_motion(const std::string& toml, const Stretches& exact, const Exact& force, const std::vector<double>& jumps) {
  check_at_all_accuracies(toml, {{"a.position", [&](double t) { return exact.position(t); }},
                                 {"a.velocity", [&](double t) { return exact.velocity(t); }}});
  check_between(toml, {{"brake.force", force}, {"m1.force", [&](double t) { return m * exact.acceleration(t); }}}, jumps);
}

}  // namespace

TEST_CASE("brake: a ramped normal force stops a mass at sqrt(2 m v0/(mu r))") {
  const double r = 4.3;
  for (const double v0 : {0.91, -0.57}) {
    const double s = v0 > 0 ? 1 : -1, locks = std::sqrt(2 * m * std::abs(v0) / (mu * r));
    REQUIRE_LT(locks, 0.8 * stop);
    Stretches exact(0.2, v0);
    exact.accelerate(0, 0, -s * mu * r / m);
    exact.rest(locks);
    const auto force = [=](double t) { return t < locks ? s * mu * r * t : 0; };
    for (const bool rotation : {false, true}) check_motion(braked(normal(ramp(r)), v0, 0, rotation), exact, force, {locks});
    std::string with_events = braked(normal(ramp(r)), v0);
    with_events.replace(with_events.find("points = 231"), 12, "points = 2, events = true");
    check_events(with_events, {locks});
    // The sliding force itself as the signal.
    check_motion(braked("coulomb = " + ramp(mu * r), v0), exact, force, {locks});
    // The kinetic energy becomes heat.
    check_account(braked(normal(ramp(r)), v0), {0, -m * v0 * v0 / 2, m * v0 * v0 / 2});
  }
}

TEST_CASE("brake: a mass is released as the normal force falls, with and without a peak") {
  const double N0 = 31.7, r = 19.3;
  for (const double F : {5.9, -7.3}) {
    for (const double peak : {1.0, 1.27}) {
      const double s = F > 0 ? 1 : -1, size = std::abs(F), slips = (N0 - size / (mu * peak)) / r, apart = N0 / r;
      REQUIRE_GT(slips, 0.2);
      REQUIRE_LT(apart, 0.9 * stop);
      Stretches exact(0.2, 0);
      exact.accelerate(slips, s * (size - size / peak) / m, s * mu * r / m);
      exact.accelerate(apart, F / m);
      const auto force = [=](double t) { return t < slips ? F : s * mu * std::max(0.0, N0 - r * t); };
      const std::string more = peak > 1 ? fmt::format(", peak = {:.17g}", peak) : "";
      const std::string toml = braked(normal(ramp(-r, N0), more), 0, F);
      check_motion(toml, exact, force, {slips});
      const double supplied = F * (exact.position(stop) - 0.2), stored = m * std::pow(exact.velocity(stop), 2) / 2;
      check_account(toml, {supplied, stored, supplied - stored});
      // A breakaway force of its own does the same until it slips.
      if (peak > 1) continue;
      Stretches constant(0.2, 0);
      constant.accelerate(slips, (F - s * mu * 3.1) / m);
      check_motion(braked(fmt::format("coulomb = {:.17g}, breakaway = {}", mu * 3.1, ramp(-mu * r, mu * N0)), 0, F), constant,
                   [=](double t) { return t < slips ? F : s * mu * 3.1; }, {slips});
    }
  }
}

TEST_CASE("brake: the normal force steps while the mass slips") {
  const double v0 = 1.31, first = 0.31, second = 0.83;
  const Points N = {{0, 1.1}, {first, 1.1}, {first, 7.9}, {second, 7.9}, {second, 2.3}, {stop, 2.3}};
  Stretches exact(0.2, v0);
  exact.accelerate(0, -mu * 1.1 / m);
  exact.accelerate(first, -mu * 7.9 / m);
  REQUIRE_GT(exact.velocity(second), 0.1);
  exact.accelerate(second, -mu * 2.3 / m);
  const double locks = second + exact.velocity(second) / (mu * 2.3 / m);
  exact.rest(std::min(locks, stop));
  check_motion(braked(normal(table(N)), v0), exact, [=](double t) { return t < locks ? mu * value(N, t) : 0; },
               {first, second, locks});
}

TEST_CASE("brake: a normal force below 0 counts as 0, and the mass coasts") {
  const double v0 = 0.83;
  const Points N = {{0, 3.1}, {0.61, -4.7}, {1.13, -2.9}, {1.57, 21.3}, {stop, 2.7}};
  const Points N_positive = positive_part(N);
  Stretches exact(0.2, v0);
  double locks = HUGE_VAL;
  for (std::size_t k = 0; k + 1 < N_positive.size() && locks == HUGE_VAL; ++k) {
    const auto& [t0, y0] = N_positive[k];
    const auto& [t1, y1] = N_positive[k + 1];
    exact.accelerate(t0, -mu * y0 / m, -mu * (y1 - y0) / (t1 - t0) / m);
    if (const double stops = exact.stop_after(t0); stops < t1) exact.rest(locks = stops);
  }
  REQUIRE_GT(locks, 1.2);  // after the coasting
  REQUIRE_LT(locks, 2);
  for (const bool rotation : {false, true}) {
    check_motion(braked(normal(table(N)), v0, 0, rotation), exact,
                 [=](double t) { return t < locks ? mu * value(N_positive, t) : 0; }, {locks});
  }
}

// A spring pulled at constant speed V against a brake without mass. The force never exceeds the bound b and never rises faster
// than k V. It is the largest such force (Skorokhod's problem):
//     f(t) = min(k V t, min over s <= t of b(s) + k V (t - s)).
// The minimum is at a corner of b, or at t.
TEST_CASE("brake: a spring in series with a brake, pulled at constant speed") {
  const double k = 143, V = 0.0931, rate = k * V;
  const std::vector<Points> normals = {
      {{0, 9.1}, {stop, 31.3}},                                                 // rises slowly: it slips from an instant on
      {{0, 27.3}, {1.1, 11.9}, {stop, 12.1}},                                   // falls
      {{0, 9.7}, {0.9, 15.3}, {1.2, 43.1}, {1.9, 29.3}, {stop, 29.3}},          // rises faster than the spring: it sticks
      {{0, 14.3}, {0.8, 14.3}, {0.8, 5.9}, {1.3, 8.1}, {1.3, 37.1}, {stop, 3.7}},  // jumps down while it slips, then up
      {{0, 14.3}, {0.7, -9.1}, {1.2, -3.1}, {1.6, 30.7}, {stop, 11.3}},         // lets go for a while
  };
  for (const Points& N : normals) {
    const Points bound = positive_part(N);
    const auto force = [&](double t) {
      double least = std::min(rate * t, mu * value(bound, t));
      for (const auto& [s, y] : bound) {
        if (s <= t) least = std::min(least, mu * y + rate * (t - s));
      }
      return least;
    };
    std::vector<double> jumps;
    for (std::size_t j = 1; j < bound.size(); ++j) {
      if (bound[j].first == bound[j - 1].first) jumps.push_back(bound[j].first);
    }
    for (const double s : {1.0, -1.0}) {
      const std::string toml = fmt::format(R"(
[elements]
hand  = {{ type = "motion", at = "h", velocity = {:.17g} }}
k1    = {{ type = "spring", between = ["h", "n"], stiffness = {:.17g} }}
brake = {{ type = "slider", between = ["n", "ground"], {} }}
[simulate]
stop = {:.17g}
output = {{ points = 231 }}
)",
                                           s * V, k, normal(table(N)), stop);
      check_between(toml, {{"brake.force", [&](double t) { return s * force(t); }},
                           {"hand.force", [&](double t) { return s * force(t); }},
                           {"n.position", [&](double t) { return s * (V * t - force(t) / k); }}}, jumps);
      const double slid = V * stop - force(stop) / k;
      CHECK_GT(slid, 0.01);
      for (const double accuracy : accuracies) {
        const Summary summary = outcome(toml, accuracy).summary;
        CHECK_LE(std::abs(summary.missing), 10 * accuracy * summary.largest);
        CHECK_LE(std::abs(summary.stored - std::pow(force(stop), 2) / (2 * k)), 10 * accuracy * summary.largest);
      }
    }
  }
}

TEST_CASE("brake: two brakes share a load with least norm while the bound of one falls below its share") {
  const double F = 9.7, held = 6.3, b0 = 8.9, r = 3.7;
  // Halves until the second can take no more than its half, then the first takes the rest until it slips too.
  const double bound_at = (b0 - F / 2) / r, slips = (b0 - (F - held)) / r, apart = b0 / r;
  REQUIRE_LT(slips, stop - 0.3);
  REQUIRE_GT(apart, stop);
  for (const double s : {1.0, -1.0}) {
    const std::string toml = fmt::format(R"(
[elements]
m1     = {{ type = "mass", at = "a", mass = {:.17g} }}
push   = {{ type = "force", at = "a", force = {:.17g} }}
first  = {{ type = "slider", between = ["a", "ground"], coulomb = {:.17g} }}
second = {{ type = "slider", between = ["ground", "a"], coulomb = {:.17g}, normal = {} }}
[simulate]
stop = {:.17g}
output = {{ points = 231 }}
)",
                                         m, s * F, held, mu, ramp(-r / mu, b0 / mu), stop);
    Stretches exact(0, 0);
    exact.accelerate(slips, 0, s * r / m);
    check_at_all_accuracies(toml, {{"a.position", [&](double t) { return exact.position(t); }},
                                   {"a.velocity", [&](double t) { return exact.velocity(t); }},
                                   {"second.force", [&](double t) { return -s * (t < bound_at ? F / 2 : b0 - r * t); }},
                                   {"first.force", [&](double t) { return s * (t < bound_at ? F / 2 : t < slips ? F - b0 + r * t : held); }}});
    const double supplied = s * F * exact.position(stop), stored = m * std::pow(exact.velocity(stop), 2) / 2;
    check_account(toml, {supplied, stored, supplied - stored});
  }
}

// N = c v makes a dashpot of mu c; for v < 0 the surfaces are apart.
TEST_CASE("brake: a normal force that follows the speed is a dashpot") {
  const double c = 7.9, rate = mu * c / m;
  for (const double v0 : {0.71, -0.71}) {
    const std::string toml = braked(normal("{ block = \"g\" }"), v0, 0, false,
                                    fmt::format("\n[elements.g]\ntype = \"gain\"\nin = \"a.velocity\"\ngain = {:.17g}\n", c));
    if (v0 > 0) {
      check_at_all_accuracies(toml, {{"a.velocity", [=](double t) { return v0 * std::exp(-rate * t); }},
                                     {"a.position", [=](double t) { return 0.2 - v0 / rate * std::expm1(-rate * t); }},
                                     {"brake.force", [=](double t) { return mu * c * v0 * std::exp(-rate * t); }}});
    } else {
      check_at_all_accuracies(toml, {{"a.velocity", [=](double) { return v0; }},
                                     {"a.position", [=](double t) { return 0.2 + v0 * t; }}});
    }
  }
}

// A stretched spring presses the surfaces together in proportion to its force. Friction adds to its force on the way out and takes
// from it on the way back: the stiffness is k (1 + mu) and k (1 - mu). A compressed spring presses nothing: there it is k.
TEST_CASE("brake: a normal force from the force of a spring") {
  const double k = 61.3, x0 = 0.173;
  const double back = std::sqrt(k * (1 - mu) / m), free = std::sqrt(k / m), out = std::sqrt(k * (1 + mu) / m);
  const double pi = std::numbers::pi, quarter = pi / 2;
  const double t1 = quarter / back, t2 = t1 + pi / free, t3 = t2 + quarter / out, ratio = back / out;
  const auto phase = [=](double t) {
    double x = x0;
    while (t > t3) t -= t3, x *= ratio;
    return std::pair{t, x};
  };
  const auto position = [=](double t) {
    const auto [u, x] = phase(t);
    if (u < t1) return x * std::cos(back * u);
    if (u < t2) return -x * back / free * std::sin(free * (u - t1));
    return x * ratio * std::sin(out * (u - t2));
  };
  const auto velocity = [=](double t) {
    const auto [u, x] = phase(t);
    if (u < t1) return -x * back * std::sin(back * u);
    if (u < t2) return -x * back * std::cos(free * (u - t1));
    return x * back * std::cos(out * (u - t2));
  };
  const auto friction = [=](double t) {
    const double u = phase(t).first;
    return (u < t1 ? -1 : u < t2 ? 0 : 1) * mu * k * position(t);
  };
  REQUIRE_GT(stop, 1.5 * t3);
  const std::string toml = fmt::format(R"(
[elements]
m1    = {{ type = "mass", at = "a", mass = {:.17g} }}
k1    = {{ type = "spring", between = ["a", "ground"], stiffness = {:.17g} }}
press = {{ type = "gain", in = "k1.force", gain = 1 }}
brake = {{ type = "slider", between = ["ground", "a"], coulomb = {:.17g}, normal = {{ block = "press" }} }}
[nodes]
a = {{ position = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ points = 231 }}
)",
                                       m, k, mu, x0, stop);
  check_at_all_accuracies(toml, {{"a.position", position}, {"a.velocity", velocity}});
  check_between(toml, {{"brake.force", [&](double t) { return -friction(t); }}}, {t3});
  const double stored = (m * std::pow(velocity(stop), 2) + k * (std::pow(position(stop), 2) - x0 * x0)) / 2;
  check_account(toml, {0, stored, -stored});
}

TEST_CASE("clutch: two inertias come to a common speed") {
  const double J1 = 0.213, J2 = 0.577, fast = 11.3, T = 1.9, r = 6.1;
  // The torque of the clutch is mu r t while it slips; then it drives the second inertia alone.
  Stretches first(0, fast), second(0, -2.7), relative(0, fast + 2.7);
  first.accelerate(0, T / J1, -mu * r / J1);
  second.accelerate(0, 0, mu * r / J2);
  relative.accelerate(0, T / J1, -mu * r * (1 / J1 + 1 / J2));
  const double sync = relative.stop_after(0), common = T / (J1 + J2);
  REQUIRE_LT(sync, 2.7);
  REQUIRE_LT(T * J2 / (J1 + J2), mu * r * sync);
  // Momentum: that of the start, and that of the torque T.
  CHECK(first.velocity(sync) == doctest::Approx((J1 * fast - J2 * 2.7 + T * sync) / (J1 + J2)).epsilon(1e-12));
  first.accelerate(sync, common);
  second.accelerate(sync, common);
  const double end = 3.1;
  const std::string toml = fmt::format(R"(
domain = "rotation"
[elements]
engine = {{ type = "inertia", at = "e", inertia = {:.17g} }}
load   = {{ type = "inertia", at = "l", inertia = {:.17g} }}
drive  = {{ type = "torque", at = "e", torque = {:.17g} }}
clutch = {{ type = "slider", between = ["e", "l"], coulomb = {:.17g}, normal = {{ ramp = {:.17g} }} }}
[nodes]
e = {{ velocity = {:.17g} }}
l = {{ velocity = -2.7 }}
[simulate]
stop = {:.17g}
output = {{ points = 311 }}
)",
                                       J1, J2, T, mu, r, fast, end);
  check_at_all_accuracies(toml, {{"e.velocity", [&](double t) { return first.velocity(t); }},
                                 {"l.velocity", [&](double t) { return second.velocity(t); }},
                                 {"l.position", [&](double t) { return second.position(t); }}});
  check_between(toml, {{"clutch.force", [&](double t) { return t < sync ? mu * r * t : T * J2 / (J1 + J2); }}}, {sync});
  const double supplied = T * first.position(end);
  const double stored = (J1 * (std::pow(first.velocity(end), 2) - fast * fast) + J2 * (std::pow(second.velocity(end), 2) - 2.7 * 2.7)) / 2;
  check_account(toml, {supplied, stored, supplied - stored});
}

TEST_CASE("brake: without dry friction it has no force") {
  for (const std::string& brake : {normal(ramp(4.3)), normal("5"), "coulomb = " + ramp(4.3), normal("{ block = \"g\" }", ", peak = 1.3")}) {
    const std::string toml = braked(brake, 0.91, 0.7, false,
                                    "\n[effects]\nwithout = [\"dry_friction\"]\n[elements.g]\ntype = \"gain\"\nin = \"a.velocity\"\ngain = 3\n");
    check_at_all_accuracies(toml, {{"a.velocity", [](double t) { return 0.91 + 0.7 / m * t; }}});
    CHECK_EQ(simulate(toml).scale("brake.force"), 0);
  }
}

}  // namespace rheonet::test::brake_test
