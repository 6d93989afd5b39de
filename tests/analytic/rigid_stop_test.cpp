// Rigid stops: the displacement stays within its bounds, and w = -e w_before at an impact.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::rigid_stop_test {

namespace {

constexpr double pi = std::numbers::pi;

/// A ball that falls from h onto a floor, with g and e.
struct Ball {
  double h, g, e;

  double first() const { return std::sqrt(2 * h / g); }
  /// Time of impact n = 0, 1, ...: t_n = t_0 + 2 t_0 (e + e^2 + ... + e^n).
  double impact(int n) const { return first() * (1 + 2 * (e == 1 ? n : e * (1 - std::pow(e, n)) / (1 - e))); }
  double rest() const { return e == 1 ? HUGE_VAL : first() * (1 + e) / (1 - e); }
  /// Number of impacts until t.
  int impacts(double t) const {
    int n = 0;
    while (n < 3000 && impact(n) <= t) ++n;
    return n;
  }
  double height(double t) const {
    if (t >= rest()) return 0;
    const int n = impacts(t);
    if (n == 0) return h - g * t * t / 2;
    const double u = t - impact(n - 1), v = g * first() * std::pow(e, n);
    return std::max(0.0, v * u - g * u * u / 2);
  }
  double velocity(double t) const {
    if (t >= rest()) return 0;
    const int n = impacts(t);
    return n == 0 ? -g * t : g * first() * std::pow(e, n) - g * (t - impact(n - 1));
  }
};

std::string with_events(std::string toml, int points = 2) {
  const std::string before = "points = 201";
  return toml.replace(toml.find(before), before.size(), fmt::format("points = {}, events = true", points));
}

/// Times of rows in pairs, before and after an event.
std::vector<double> event_times(const RunTable& rows) {
  std::vector<double> found;
  for (std::size_t row = 1; row < rows.time().size(); ++row) {
    if (rows.time()[row] == rows.time()[row - 1] && rows.time()[row] > 0) found.push_back(rows.time()[row]);
  }
  return found;
}

}  // namespace

// The impacts accumulate at t_0 (1 + e)/(1 - e), and the ball rests from there on.
TEST_CASE("rigid stop: a ball bounces on a floor that rests or moves evenly, seen from both sides") {
  const double h = 0.83, g = 9.81, m = 0.7;
  for (const double e : {0.0, 0.5, 0.9, 1.0}) {
    const Ball ball{h, g, e};
    const double stop = e == 1 ? 9.3 * ball.first() : 1.31 * ball.rest();
    std::vector<double> jumps;
    for (int n = 0; n < ball.impacts(stop); ++n) jumps.push_back(ball.impact(n));
    if (e < 1) jumps.push_back(ball.rest());
    for (const double V : {0.0, 1.7}) {
      for (const double s : {1.0, -1.0}) {
        // The mirror image has the nodes the other way round: there the bound is the upper one.
        const std::string toml = netlist({{"m", m}, {"F", -m * g}, {"h", h}, {"e", e}, {"V", V}}, fmt::format(R"(
[nodes]
ball = {{ position = "h", velocity = "V" }}
[elements]
mass   = {{ type = "mass", at = "ball", mass = "m" }}
weight = {{ type = "force", at = "ball", force = "F" }}
drive  = {{ type = "motion", at = "floor", velocity = "V" }}
stop   = {{ type = "stop", between = [{}], {} = 0, stiffness = "inf", restitution = "e" }}
)", s > 0 ? "\"ball\", \"floor\"" : "\"floor\", \"ball\"", s > 0 ? "lower" : "upper"), stop);
        const Expectations expected = {{"ball.position", [&](double t) { return V * t + ball.height(t); }},
                                       {"ball.velocity", [&](double t) { return V + ball.velocity(t); }, V + g * ball.first()},
                                       {"stop.displacement", [&](double t) { return s * ball.height(t); }, h},
                                       {"stop.force", [&](double t) { return t >= ball.rest() ? -s * m * g : 0; }, m * g}};
        check_between(toml + record(expected), expected, jumps);
        if (e == 1) continue;
        // It rests without chattering: to the last bit.
        for (const double accuracy : accuracies) {
          const RunTable rows = simulate(with_events(toml, 201) + "record = [\"stop.velocity\", \"stop.displacement\"]\n", accuracy);
          const double since = ball.rest() * (1 + 1e-12);  // the event itself has a row before it
          check_exactly(rows, "stop.velocity", 0, since);
          check_constant(rows, "stop.displacement", since);
          const std::vector<double> found = event_times(rows);
          // No event once the hops are below the accuracy: e^n = accuracy/4.
          const double enough = e == 0 ? 1 : std::log(accuracy / 4) / std::log(e) + 3;
          CHECK_LE(found.size(), enough);
          for (std::size_t n = 0; n < found.size(); ++n) CHECK_LE(std::abs(found[n] - ball.impact(static_cast<int>(n))), 10 * accuracy * stop);
        }
      }
    }
  }
}

// The last hops follow each other faster than anything else here changes: no chattering, but rest at the accumulation point.
TEST_CASE("rigid stop: almost elastic, thousands of impacts end in rest") {
  const Ball ball{0.83, 9.81, 0.997};
  const double stop = 1.1 * ball.rest();
  const RunTable rows = simulate(with_events(netlist({{"h", ball.h}}, R"(
[nodes]
ball = { position = "h" }
[elements]
mass   = { type = "mass", at = "ball", mass = 1 }
weight = { type = "force", at = "ball", force = -9.81 }
stop   = { type = "stop", between = ["ball", "ground"], lower = 0, stiffness = "inf", restitution = 0.997 }
)", stop)) + "record = [\"ball.position\", \"stop.force\"]\n", 1e-6);
  const std::vector<double> found = event_times(rows);
  REQUIRE_FALSE(found.empty());
  CHECK_LE(std::abs(found.back() - ball.rest()), 1e-6 * stop);
  CHECK_EQ(rows["ball.position"].back(), 0);
  CHECK_EQ(rows["stop.force"].back(), -9.81);
}

// m v1' + M v2' is kept, and v2' - v1' = e (v1 - v2).
TEST_CASE("rigid stop: two bodies collide") {
  const double m = 0.7, M = 2.3, v = 1.9, u = -0.4, gap = 0.31, stop = 0.4, hit = gap / (v - u);
  for (const double e : {0.0, 0.37, 1.0}) {
    const double common = (m * v + M * u) / (m + M), v1 = common - e * M / (m + M) * (v - u), u1 = common + e * m / (m + M) * (v - u);
    const std::string toml = netlist({{"m", m}, {"M", M}, {"v", v}, {"u", u}, {"gap", gap}, {"e", e}}, R"(
[nodes]
a = { position = 0, velocity = "v" }
b = { position = "gap", velocity = "u" }
[elements]
left  = { type = "mass", at = "a", mass = "m" }
right = { type = "mass", at = "b", mass = "M" }
stop  = { type = "stop", between = ["b", "a"], lower = 0, stiffness = "inf", restitution = "e" }
)", stop);
    const auto before_after = [=](double before, double after) { return [=](double t) { return t < hit ? before : after; }; };
    const Expectations expected = {{"a.velocity", before_after(v, v1)}, {"b.velocity", before_after(u, u1)},
                                   {"stop.displacement", [=](double t) { return t < hit ? gap - (v - u) * t : e * (v - u) * (t - hit); }},
                                   {"b.position", [=](double t) { return gap + (t < hit ? u * t : u * hit + u1 * (t - hit)); }},
                                   {"stop.force", [](double) { return 0; }, 1}};
    check_between(toml + record(expected), expected, {hit});
    const double lost = (1 - e * e) * m * M / (m + M) * (v - u) * (v - u) / 2;
    check_account(toml, {.supplied = 0, .stored = -lost, .dissipated = lost});
  }
}

// With gaps the impacts follow one another, and the last ball flies off. Balls that touch are hit at once: Newton's law then says
// w = -e w_before = 0 at the contact that only touched.
TEST_CASE("rigid stop: balls in a row, with gaps and without") {
  const double v = 1.3;
  const auto after = [&](double gap, double e) {
    return simulate(netlist({{"v", v}, {"gap", gap}, {"x3", 0.5 + gap}, {"e", e}}, R"(
[nodes]
a = { velocity = "v" }
b = { position = 0.5, velocity = 0 }
c = { position = "x3", velocity = 0 }
[elements]
A  = { type = "mass", at = "a", mass = 1 }
B  = { type = "mass", at = "b", mass = 1 }
C  = { type = "mass", at = "c", mass = 1 }
ab = { type = "stop", between = ["b", "a"], lower = 0, stiffness = "inf", restitution = "e" }
bc = { type = "stop", between = ["c", "b"], lower = 0, stiffness = "inf", restitution = "e" }
)", 0.45, 3) + "record = [\"a.velocity\", \"b.velocity\", \"c.velocity\"]\n", 1e-9);
  };
  const auto check = [](const RunTable& rows, double a, double b, double c) {
    CHECK(rows["a.velocity"].back() == doctest::Approx(a).epsilon(1e-9));
    CHECK(rows["b.velocity"].back() == doctest::Approx(b).epsilon(1e-9));
    CHECK(rows["c.velocity"].back() == doctest::Approx(c).epsilon(1e-9));
  };
  check(after(0.01, 1), 0, 0, v);
  const double e = 0.6, b = (1 + e) / 2 * v;
  check(after(0.01, e), (1 - e) / 2 * v, (1 - e) / 2 * b, (1 + e) / 2 * b);
  for (const double f : {1.0, 0.6, 0.0}) check(after(0, f), v * (1 - 2 * f) / 3, v * (1 + f) / 3, v * (1 + f) / 3);
}

// Each half-swing takes half a period of the spring, and is e times as wide as the last one.
TEST_CASE("rigid stop: an impact oscillator") {
  const double m = 1.3, k = 210, v0 = 0.71, omega = std::sqrt(k / m), half = pi / omega, stop = 6.37 * half;
  for (const double e : {0.8, 1.0}) {
    const auto swing = [=](double t) { return std::pow(e, std::floor(t / half)); };
    std::vector<double> jumps;
    for (double t = half; t < stop; t += half) jumps.push_back(t);
    const Expectations expected = {{"x.position", [=](double t) { return -swing(t) * v0 / omega * std::sin(omega * std::fmod(t, half)); }},
                                   {"x.velocity", [=](double t) { return -swing(t) * v0 * std::cos(omega * std::fmod(t, half)); }}};
    const std::string toml = netlist({{"m", m}, {"k", k}, {"v", -v0}, {"e", e}}, R"(
[nodes]
x = { velocity = "v" }
[elements]
mass   = { type = "mass", at = "x", mass = "m" }
spring = { type = "spring", between = ["x", "ground"], stiffness = "k" }
stop   = { type = "stop", between = ["x", "ground"], upper = 0, stiffness = "inf", restitution = "e" }
)", stop);
    check_between(toml + record(expected), expected, jumps);
    check_events(with_events(toml), jumps);
  }
}

// m x'' = F cos(W t): pressed until the force turns round, then x = F/(m W^2) (1 - cos s - ...) of the time since.
TEST_CASE("rigid stop: a pressed mass leaves when the load turns round, and comes back") {
  const double m = 0.9, F = 3.1, W = 2 * pi * 0.83, leaves = pi / 2 / W, bound = 0.041;
  const auto x = [=](double t) {  // m x'' = -F sin(W s), x = x' = 0 at s = 0
    const double s = W * (t - leaves);
    return t < leaves ? bound : bound - F / (m * W * W) * (s - std::sin(s));
  };
  const Expectations expected = {{"x.position", x, 0}, {"stop.force", [=](double t) { return t < leaves ? F * std::cos(W * t) : 0; }}};
  const std::string toml = netlist({{"m", m}, {"F", F}, {"W", W / (2 * pi)}, {"bound", bound}}, R"(
[nodes]
x = { position = "bound" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
load = { type = "force", at = "x", force = { cosine = "F", frequency = "W" } }
stop = { type = "stop", between = ["x", "ground"], upper = "bound", stiffness = "inf" }
)", 4 * leaves);
  check_at_all_accuracies(toml + record(expected), expected);
  check_events(with_events(toml), {leaves});
}

TEST_CASE("rigid stop: in series with a spring, without mass between") {
  const double ks = 170, amplitude = 0.0471, omega = 2 * pi * 0.71, low = -0.031, high = 0.023;
  const auto a = [=](double t) { return amplitude * std::sin(omega * t); };
  const auto x = [=](double t) { return std::clamp(a(t), low, high); };
  const Expectations expected = {{"x.position", x}, {"stop.force", [=](double t) { return ks * (a(t) - x(t)); }}};
  const std::string nodes = netlist({{"ks", ks}, {"low", low}, {"high", high}, {"A", amplitude}}, R"(
[elements]
drive  = { type = "motion", at = "a", position = { sine = "A", frequency = 0.71 } }
spring = { type = "spring", between = ["a", "x"], stiffness = "ks" }
stop   = { type = "stop", between = ["x", "ground"], lower = "low", upper = "high", stiffness = "inf", restitution = 0.8 }
)", 2.3);
  check_at_all_accuracies(nodes + record(expected), expected);
  const Expectations composed = {{"pad.force", [=](double t) { return ks * (a(t) - x(t)); }}, {"pad.stop.displacement", x}};
  check_at_all_accuracies(netlist({{"ks", ks}, {"low", low}, {"high", high}, {"A", amplitude}}, R"(
[elements]
drive = { type = "motion", at = "a", position = { sine = "A", frequency = 0.71 } }
[elements.pad]
between = ["a", "ground"]
series = [ { name = "spring", type = "spring", stiffness = "ks" },
           { name = "stop", type = "stop", lower = "low", upper = "high", stiffness = "inf", restitution = 0.8 } ]
)", 2.3) + record(composed), composed);
}

// c x' = F up to the stop, where the stop takes F.
TEST_CASE("rigid stop: a push through a dashpot, and a step through a spring") {
  const double F = 3.7, c = 91, bound = 0.023, meet = bound * c / F;
  const Expectations pushed = {{"x.position", [=](double t) { return std::min(F / c * t, bound); }}, {"stop.force", from(meet, [=](double) { return F; })}};
  check_between(netlist({{"bound", bound}, {"F", F}, {"c", c}}, R"(
[elements]
push = { type = "force", at = "x", force = "F" }
oil  = { type = "dashpot", between = ["x", "ground"], damping = "c" }
stop = { type = "stop", between = ["x", "ground"], upper = "bound", stiffness = "inf" }
)", 1.1) + record(pushed), pushed, {meet});

  // The node without mass goes with the hand up to the bound.
  const double k1 = 170, k2 = 60, t0 = 0.43;
  for (const double step : {0.02, 0.05}) {
    const double x = std::min(step * k1 / (k1 + k2), bound);
    const Expectations stepped = {{"x.position", from(t0, [=](double) { return x; })},
                                  {"stop.force", from(t0, [=](double) { return k1 * (step - x) - k2 * x; }), 1}};
    check_at_all_accuracies(netlist({{"bound", bound}, {"step", step}, {"k1", k1}, {"k2", k2}}, R"(
[elements]
hand = { type = "motion", at = "a", position = { step = "step", time = 0.43 } }
k1   = { type = "spring", between = ["a", "x"], stiffness = "k1" }
k2   = { type = "spring", between = ["x", "ground"], stiffness = "k2" }
stop = { type = "stop", between = ["x", "ground"], upper = "bound", stiffness = "inf" }
)", 1.1) + record(stepped), stepped);
  }
}

// The hand jumps back and forth. On the way back the node y leaves one bound and meets the other, and x leaves its own.
TEST_CASE("rigid stop: steps through springs open and close two stops at once") {
  const double k = 100, x_high = 0.3, y_high = 0.1, y_low = -0.2;
  const auto high = [](double t) { return std::fmod(t, 1) < 0.5; };
  const Expectations expected = {{"x.position", [=](double t) { return high(t) ? x_high : (y_low - 1) / 2; }},
                                 {"y.position", [=](double t) { return high(t) ? y_high : y_low; }},
                                 {"s1.force", [=](double t) { return high(t) ? k * (1 - 2 * x_high + y_high) : 0; }},
                                 {"s2.force", [=](double t) { return high(t) ? k * (x_high - 2 * y_high) : k * ((y_low - 1) / 2 - 2 * y_low); }}};
  const std::string toml = netlist({{"k", k}, {"x_high", x_high}, {"y_high", y_high}, {"y_low", y_low}}, R"(
[elements]
hand = { type = "motion", at = "a", position = { square = 1, frequency = 1 } }
k1 = { type = "spring", between = ["a", "x"], stiffness = "k" }
k2 = { type = "spring", between = ["x", "y"], stiffness = "k" }
k3 = { type = "spring", between = ["y", "ground"], stiffness = "k" }
s1 = { type = "stop", between = ["x", "ground"], upper = "x_high", stiffness = "inf" }
s2 = { type = "stop", between = ["y", "ground"], lower = "y_low", upper = "y_high", stiffness = "inf" }
)", 2.3, 203);
  check_at_all_accuracies(toml + record(expected), expected);
  for (const double accuracy : accuracies) CHECK_LE(std::abs(outcome(toml, accuracy).summary.dissipated), 1e-12);
}

// Both hold the block: they share the load with the least sum of squares within the bounds of the friction.
TEST_CASE("rigid stop: pressed, with friction in parallel") {
  const double m = 1.1, F = 9.7, bound = 0.3;
  for (const double Fc : {2.3, 7.1}) {
    const double a = (F - Fc) / m, meet = std::sqrt(2 * bound / a), by_friction = std::min(Fc, F / 2);
    const Expectations expected = {{"x.position", [=](double t) { return t < meet ? a * t * t / 2 : bound; }},
                                   {"stop.force", from(meet, [=](double) { return F - by_friction; })},
                                   {"rub.force", [=](double t) { return t < meet ? Fc : by_friction; }}};
    const std::string toml = netlist({{"m", m}, {"F", F}, {"Fc", Fc}, {"bound", bound}}, R"(
[elements]
mass = { type = "mass", at = "x", mass = "m" }
load = { type = "force", at = "x", force = "F" }
rub  = { type = "slider", between = ["x", "ground"], coulomb = "Fc" }
stop = { type = "stop", between = ["x", "ground"], upper = "bound", stiffness = "inf" }
)", 1.7);
    check_between(toml + record(expected), expected, {meet});
    check_account(toml, {.supplied = F * bound, .stored = 0, .dissipated = F * bound});
  }
}

// A gear, a rigid link and an inerter beside the mass: the effective mass is m + b + J/i^2 there.
TEST_CASE("rigid stop: behind a gear, with a rigid link and an inerter") {
  const double m = 0.7, b = 0.4, J = 0.3, i = -2.5, F = 2.1, e = 0.6, bound = 0.13;
  const double mass = m + b + J / (i * i), a = F / mass, meet = std::sqrt(2 * bound / a), v = a * meet, next = meet + 2 * e * v / a;
  const auto x = [=](double t) {
    const double u = t - meet;
    return t < meet ? a * t * t / 2 : bound - e * v * u + a * u * u / 2;
  };
  const std::string common = R"(
[elements]
mass  = { type = "mass", at = "x", mass = "m" }
link  = { type = "dashpot", between = ["x", "y"], damping = "inf" }
load  = { type = "force", at = "y", force = "F" }
inert = { type = "inerter", between = ["y", "ground"], inertance = "b" }
gear  = { type = "gear", between = ["y", "z"], ratio = "i" }
far   = { type = "mass", at = "z", mass = "J" }
)";
  // In the motion of z the bound is upper/i: below 0 where the gear turns the motion round.
  for (const std::string stop : {"stop = { type = \"stop\", between = [\"y\", \"ground\"], upper = \"bound\", stiffness = \"inf\", restitution = \"e\" }\n",
                                 "stop = { type = \"stop\", between = [\"z\", \"ground\"], lower = \"bound/i\", stiffness = \"inf\", restitution = \"e\" }\n"}) {
    const Expectations expected = {{"x.position", x}, {"z.position", [=](double t) { return x(t) / i; }}};
    check_at_all_accuracies(netlist({{"m", m}, {"b", b}, {"J", J}, {"i", i}, {"F", F}, {"e", e}, {"bound", bound}}, common + stop, 0.97 * next) + record(expected),
                            expected);
  }
}

TEST_CASE("rigid stop: rest is found between the bounds and at them") {
  const double ks = 70, low = -0.031, high = 0.023;
  for (const double bound : {high, low}) {
    for (const double share : {0.93, 1.0, 1.07, 4.1}) {
      const double F = share * ks * bound, d = std::min(share, 1.0) * bound;
      const Expectations expected = {{"x.position", [=](double) { return d; }}, {"stop.force", [=](double) { return F - ks * d; }, std::abs(F)}};
      check_at_all_accuracies(netlist({{"ks", ks}, {"low", low}, {"high", high}, {"F", F}}, R"(
[elements]
mass   = { type = "mass", at = "x", mass = 1.3 }
load   = { type = "force", at = "x", force = "F" }
spring = { type = "spring", between = ["x", "ground"], stiffness = "ks" }
stop   = { type = "stop", between = ["x", "ground"], lower = "low", upper = "high", stiffness = "inf" }
)", 1.7) + "start_from = \"rest\"\n" + record(expected), expected);
    }
  }
  // Nothing else holds the upper block: it lies on the lower one, and that on the floor.
  const Expectations pile = {{"a.position", [](double) { return 0.2; }}, {"b.position", [](double) { return 0.5; }},
                             {"floor.force", [](double) { return -30; }}, {"between.force", [](double) { return -10; }}};
  check_at_all_accuracies(netlist({}, R"(
[nodes]
a = { position = 1 }
b = { position = 2 }
[elements]
A = { type = "mass", at = "a", mass = 2 }
B = { type = "mass", at = "b", mass = 1 }
GA = { type = "force", at = "a", force = -20 }
GB = { type = "force", at = "b", force = -10 }
floor = { type = "stop", between = ["a", "ground"], lower = 0.2, stiffness = "inf", restitution = 0.5 }
between = { type = "stop", between = ["b", "a"], lower = 0.3, stiffness = "inf", restitution = 0.5 }
)", 1.3) + "start_from = \"rest\"\n" + record(pile), pile);
}

TEST_CASE("rigid stop: starts in contact; equal bounds are a rigid link") {
  const double m = 1.3, F = 4.1, v = 0.7;
  // Pressed, and moving against the bound: an impact at the start.
  for (const double e : {0.0, 0.5}) {
    const Summary summary = outcome(netlist({{"m", m}, {"F", F}, {"v", v}, {"e", e}}, R"(
[nodes]
x = { position = 0.2, velocity = "v" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
load = { type = "force", at = "x", force = "F" }
stop = { type = "stop", between = ["x", "ground"], upper = 0.2, stiffness = "inf", restitution = "e" }
)", 0.1)).summary;
    const std::string note = fmt::format("at t = 0 s the ends of `stop` start with an impact, which turns {:.6g} J into heat, before the energy account begins",
                                         m * v * v / 2 * (1 - e * e));
    CHECK_EQ(std::count(summary.notes.begin(), summary.notes.end(), note), 1);
  }
  const Expectations held = {{"x.position", [](double) { return 0.2; }}, {"stop.force", [=](double t) { return F * std::sin(2 * pi * t); }}};
  check_at_all_accuracies(netlist({{"m", m}, {"F", F}}, R"(
[nodes]
x = { position = 0.2 }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
load = { type = "force", at = "x", force = { sine = "F", frequency = 1 } }
stop = { type = "stop", between = ["x", "ground"], lower = 0.2, upper = 0.2, stiffness = "inf", restitution = 0.5 }
)", 1.3) + record(held), held);
}

// The floor jumps to the velocity V: the resting ball is hit, and falls back.
TEST_CASE("rigid stop: a floor that begins to move at once hits what lies on it") {
  const double m = 0.7, g = 9.81, V = 1.9, e = 0.6, t0 = 0.21, t1 = t0 + 2 * e * V / g;
  const auto x = [=](double t) { return t < t0 ? 0 : (1 + e) * V * (t - t0) - g * (t - t0) * (t - t0) / 2; };
  const Expectations expected = {{"ball.position", x}, {"stop.force", [=](double t) { return t < t0 ? -m * g : 0; }}};
  check_at_all_accuracies(netlist({{"m", m}, {"F", -m * g}, {"V", V}, {"e", e}}, R"(
[elements]
mass   = { type = "mass", at = "ball", mass = "m" }
weight = { type = "force", at = "ball", force = "F" }
drive  = { type = "motion", at = "floor", velocity = { step = "V", time = 0.21 } }
stop   = { type = "stop", between = ["ball", "floor"], lower = 0, stiffness = "inf", restitution = "e" }
)", 0.99 * t1) + record(expected), expected);
}

TEST_CASE("rigid stop: mistakes are refused") {
  const auto with = [](const std::string& parameters, const std::string& nodes = "x = { position = 0 }") {
    return refusal("[nodes]\n" + nodes + "\n[elements]\nm = { type = \"mass\", at = \"x\", mass = 1 }\ns = { type = \"stop\", between = [\"x\", \"ground\"], " +
                   parameters + " }\n[simulate]\nstop = 1\n");
  };
  const auto says = [](const std::string& text, const std::string& words) { CHECK_MESSAGE(text.find(words) != std::string::npos, text); };
  says(with("stiffness = \"inf\", lower = -0.2, damping = 1"),
       "`damping` is that of an elastic stop: a rigid one, with `stiffness = \"inf\"`, has a `restitution`");
  says(with("stiffness = 1, lower = -0.2, restitution = 0.5"),
       "`restitution` is that of a rigid stop, with `stiffness = \"inf\"`: an elastic one has a `damping`");
  says(with("stiffness = \"inf\", lower = -0.2, restitution = 1.01"), "must be at most 1");
  says(with("stiffness = \"inf\", lower = -0.2, restitution = -0.01"), "must be at least 0");
  CHECK_EQ(with("stiffness = \"inf\", lower = -0.2, restitution = 1"), "");
  CHECK_EQ(with("stiffness = \"inf\", lower = -0.2, damping = 0"), "");
  says(with("stiffness = \"inf\", lower = 0.1, upper = 0.2"),
       "element `s` cannot start with the displacement 0 m: it is rigid at its bound, 0.1 m; change the start position of node `x`, or the bound");
  says(with("stiffness = \"inf\", lower = 0.1, upper = 0.2", "x = { position = 0.3 }"), "with the displacement 0.3 m: it is rigid at its bound, 0.2 m");
  CHECK_EQ(with("stiffness = \"inf\", lower = 0.1, upper = 0.2", "x = { position = 0.2 }"), "");
  const auto driven = [](const std::string& motion) {
    return refusal("[elements]\nd = { type = \"motion\", at = \"a\", " + motion + " }\ns = { type = \"stop\", between = [\"a\", \"ground\"], upper = 0.5, "
                   "stiffness = \"inf\" }\n[simulate]\nstop = 1\n");
  };
  says(driven("velocity = 0.7"), "at t = 0.714285714 s `s` is at its bound, and the motion `d` demands that it goes on: put an element that gives way in "
                                 "series with it");
  CHECK_EQ(driven("velocity = 0.49"), "");
  says(driven("position = { step = 0.7, time = 0.3 }"), "at t = 0.3 s a step in position moves the ends of `s` by 0.2 m beyond its bound in no time, which takes "
                                                        "a force beyond any bound; give the step a time to rise in");
  CHECK_EQ(driven("position = { step = 0.5, time = 0.3 }"), "");
}

}  // namespace rheonet::test::rigid_stop_test
