// Hops against a rigid stop that end in rest although the stop itself gives (nearly) all energy back: friction takes it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::accumulating_hops_test {

namespace {

/// A mass that is pressed on a floor from the height h, with dry friction: it approaches with the acceleration `in`, departs with `out`,
/// and keeps e of its speed at an impact. So each hop has e sqrt(in/out) of the speed of the one before.
struct Pressed {
  double h, in, out, e;

  double share() const { return e * std::sqrt(in / out); }
  double first() const { return std::sqrt(2 * h / in); }
  double speed(int hop) const { return e * in * first() * std::pow(share(), hop); }
  double length(int hop) const { return speed(hop) * (1 / out + 1 / std::sqrt(in * out)); }
  double rest() const { return first() + length(0) / (1 - share()); }

  double height(double t) const { return at_time(t, true); }
  double velocity(double t) const { return at_time(t, false); }

 private:
  double at_time(double t, bool height) const {
    if (t >= rest()) return 0;
    if (t < first()) return height ? h - in * t * t / 2 : -in * t;
    double u = t - first();
    for (int hop = 0; hop < 5000; ++hop) {
      const double v = speed(hop), up = v / out;
      if (u < up) return height ? v * u - out * u * u / 2 : v - out * u;
      if (u < length(hop)) return height ? v * up / 2 - in * (u - up) * (u - up) / 2 : -in * (u - up);
      u -= length(hop);
    }
    return 0;
  }
};

}  // namespace

// Also elastic stops (e = 1). At tight accuracies the last hops are shorter than the times that modes are selected over.
TEST_CASE("accumulating hops: a pressed mass with friction beside the stop, and with that of a lever's bearing") {
  for (const double e : {1.0, 0.9999, 0.9, 1e-3, 1e-8}) {
    for (const bool lever : {false, true}) {
      CAPTURE(e);
      CAPTURE(lever);
      const double F = 2.1, friction = lever ? 0.47 : 0.83, mass = lever ? 1.1 + 0.5 / 9 : 1.1;
      const Pressed pressed{0.31, (F - friction) / mass, (F + friction) / mass, e};
      const double stop = 1.2 * pressed.rest();
      const std::string toml = netlist({{"F", -F}, {"r", friction}, {"e", e}}, fmt::format(R"(
[nodes]
a = {{ position = 0.31 }}
[elements]
m = {{ type = "mass", at = "a", mass = 1.1 }}
f = {{ type = "force", at = "a", force = "F" }}
w = {{ type = "stop", between = ["a", "ground"], lower = 0, stiffness = "inf", restitution = "e" }}
{}
)", lever ? "mb = { type = \"mass\", at = \"b\", mass = 0.5 }\ng = { type = \"lever\", between = [\"a\", \"b\"], ratio = 3, bearing = \"r\" }"
          : "s = { type = \"slider\", between = [\"a\", \"ground\"], coulomb = \"r\" }"), stop);
      const Expectations expected = {{"a.position", [&](double t) { return pressed.height(t); }},
                                     {"a.velocity", [&](double t) { return pressed.velocity(t); }}};
      std::vector<double> jumps{pressed.first()};
      for (int hop = 0; hop < 300; ++hop) jumps.push_back(jumps.back() + pressed.length(hop));
      check_between(toml + record(expected), expected, jumps);
    }
  }
}

// While the masses stick together, an impact turns back one of them alone: the friction between them brings it back to the stop. Times
// of impacts by an independent integrator (DOP853, 1e-12).
TEST_CASE("accumulating hops: a mass between stops drags another one by friction") {
  const std::string toml = R"(
[nodes]
a = { position = 0.3, velocity = -1 }
[elements]
h  = { type = "dashpot", between = ["b", "ground"], damping = 0.3 }
f  = { type = "slider", between = ["a", "b"], coulomb = 2 }
s  = { type = "stop", between = ["ground", "a"], stiffness = "inf", restitution = 0.7, lower = -0.32, upper = -0.28 }
mb = { type = "mass", at = "b", mass = 1 }
ma = { type = "mass", at = "a", mass = 0.5 }
[simulate]
stop = 2
METHOD
output = { points = 3, events = true }
record = ["a.position", "a.velocity", "b.velocity"]
)";
  for (const char* method : {"auto", "ida"}) {
    for (const double accuracy : {1e-3, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11}) {
      CAPTURE(method);
      CAPTURE(accuracy);
      const RunTable rows = simulate(std::regex_replace(toml, std::regex("METHOD"), fmt::format("method = \"{}\"", method)), accuracy);
      const std::vector<double>& v = rows["a.velocity"];
      std::vector<double> impacts;
      for (std::size_t row = 1; row < v.size(); ++row) {
        if (v[row] * v[row - 1] < 0 && rows.time()[row] == rows.time()[row - 1]) impacts.push_back(rows.time()[row]);
      }
      const std::vector<double> expected = {0.0208712153, 0.1055976348, 0.6079455705, 0.6123848047};
      REQUIRE_GE(impacts.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) CHECK_LE(std::abs(impacts[k] - expected[k]), std::max(2 * accuracy, 1e-10));
      CHECK_LE(std::abs(rows["a.position"].back() - 0.32), 1e-12);
      CHECK_EQ(v.back(), 0);
      CHECK_EQ(rows["b.velocity"].back(), 0);
    }
  }
}

// Two bodies in a row run into a wall, and a force pulls back the rear one, so that they part by an amount of second order in time. The gaps
// then shrink as their squares: after a few impacts time does not resolve the hops, while the speeds are still considerable. The limit is rest.
// The hops end once a speed is within the accuracy; it lasts until the end of the run.
TEST_CASE("accumulating hops: a body that another one meets in plastic contact in front of a wall") {
  for (const double rear : {5.3, 47.0}) {
    for (const double e : {0.13, 0.6, 0.9}) {
      const double front = 0.93, v = 1.1, pull = 1.7, gap = 0.011, wall = 0.043;
      const long double a = -pull / rear;
      long double x0 = 0, x1 = 0, v0 = v, v1 = v, t = 0;
      for (int cycle = 0; cycle < 7; ++cycle) {
        const long double there = (wall - x1) / v1;
        x0 += v0 * there + a * there * there / 2;
        v0 += a * there;
        x1 = wall;
        v1 *= -e;
        const long double apart = gap - (x0 - x1), closing = v0 - v1, back = 2 * apart / (closing + std::sqrt(closing * closing + 2 * a * apart));
        x0 += v0 * back + a * back * back / 2;
        v0 += a * back;
        x1 += v1 * back;
        v0 = v1 = (rear * v0 + front * v1) / (rear + front);
        t += there + back;
      }
      const double rest = static_cast<double>(t), stop = 1.3;
      for (const char* method : {"exact", "ida"}) {
        for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
          CAPTURE(rear);
          CAPTURE(e);
          CAPTURE(method);
          CAPTURE(accuracy);
          const RunTable rows = simulate(fmt::format(R"(
[elements]
m0 = {{ type = "mass", at = "n0", mass = {} }}
m1 = {{ type = "mass", at = "n1", mass = {} }}
pull = {{ type = "force", at = "n0", force = {} }}
g0 = {{ type = "stop", between = ["n0", "n1"], upper = {}, stiffness = "inf" }}
wall = {{ type = "stop", between = ["n1", "ground"], upper = {}, stiffness = "inf", restitution = {} }}
[nodes]
n0 = {{ velocity = {} }}
n1 = {{ velocity = {} }}
[simulate]
stop = {}
method = "{}"
record = ["n0.position", "n1.position"]
)", rear, front, -pull, gap, wall, e, v, v, stop, method), accuracy);
          const double off = std::abs(rows["n0.position"].back() - (wall + gap - pull / rear * (stop - rest) * (stop - rest) / 2));
          const double allowed = accuracy * (wall + gap + v * stop);
          CHECK_LE(off, allowed);
          CHECK_LE(std::abs(rows["n1.position"].back() - wall), allowed);
        }
      }
    }
  }
}

// A heavy body drives a ball against a wall. The ball gets faster from impact to impact until the body turns round, and slower afterwards. However
// small the gaps are, the series is finite.
TEST_CASE("accumulating hops: a series that is finite, however short its hops are, is followed to its end") {
  for (const double heavy : {100.0, 1e4}) {
    for (const double gap : {1e-14, 1e-10, 1e-6}) {
      for (const double e : {1.0, 0.98}) {
        for (const double stop : {1.0, 1e4}) {
          if (heavy > 1000 && (e < 1 || gap < 1e-9)) continue;  // thousands of impacts at one time
          double body = 1, ball = 0;
          long double x = -2 * gap, y = -gap;  // of body and ball; the wall is at 0
          const auto meet = [&] {
            const double common = (heavy * body + ball) / (heavy + 1), w = body - ball;
            body = common - e * w / (heavy + 1);
            ball = common + e * heavy * w / (heavy + 1);
          };
          for (int impact = 0; impact < 100000; ++impact) {
            const long double to_wall = ball > 0 ? -y / ball : INFINITY, to_body = body > ball ? (y - x) / (body - ball) : INFINITY, dt = std::min(to_wall, to_body);
            if (std::isinf(dt)) break;
            x += body * dt;
            y += ball * dt;
            if (to_wall < to_body) ball *= -e;
            else meet();
          }
          for (const char* method : {"exact", "ida"}) {
            CAPTURE(heavy);
            CAPTURE(gap);
            CAPTURE(e);
            CAPTURE(stop);
            CAPTURE(method);
            const RunTable rows = simulate(fmt::format(R"(
[elements]
m0 = {{ type = "mass", at = "n0", mass = {} }}
m1 = {{ type = "mass", at = "n1", mass = 1 }}
meet = {{ type = "stop", between = ["n0", "n1"], upper = {}, stiffness = "inf", restitution = {} }}
wall = {{ type = "stop", between = ["n1", "ground"], upper = {}, stiffness = "inf", restitution = {} }}
[nodes]
n0 = {{ velocity = 1 }}
[simulate]
stop = {}
method = "{}"
record = ["n0.velocity", "n1.velocity"]
)", heavy, gap, e, gap, e, stop, method));
            CHECK_LE(std::abs(rows["n0.velocity"].back() - body), 1e-6);
            CHECK_LE(std::abs(rows["n1.velocity"].back() - ball), 1e-6);
          }
        }
      }
    }
  }
}

// The middle body is met by the first one again and again, while friction holds the others together: they all go on together. IDA at 1e-11.
TEST_CASE("accumulating hops: four bodies in a row that go on together") {
  for (const char* method : {"exact", "ida"}) {
    for (const double accuracy : {1e-4, 1e-6, 1e-9}) {
      CAPTURE(method);
      CAPTURE(accuracy);
      const RunTable rows = simulate(fmt::format(R"(
[elements]
m0 = {{ type = "mass", at = "n0", mass = 1 }}
m1 = {{ type = "mass", at = "n1", mass = 0.5 }}
m2 = {{ type = "mass", at = "n2", mass = 2 }}
m3 = {{ type = "mass", at = "n3", mass = 1 }}
d3 = {{ type = "dashpot", between = ["n3", "ground"], damping = 1 }}
g0 = {{ type = "stop", between = ["n0", "n1"], upper = 0, stiffness = "inf", restitution = 0.3 }}
g1 = {{ type = "stop", between = ["n1", "n2"], upper = 0, stiffness = "inf" }}
g2 = {{ type = "stop", between = ["n2", "n3"], upper = 0, stiffness = "inf" }}
c2 = {{ type = "slider", between = ["n2", "n3"], coulomb = 1 }}
wall = {{ type = "stop", between = ["n3", "ground"], upper = 0.03, stiffness = "inf", restitution = 1 }}
[nodes]
n0 = {{ velocity = 1.96 }}
[simulate]
stop = 2.5
method = "{}"
record = ["n0.velocity", "n1.velocity", "n2.position"]
)", method), accuracy);
      CHECK_LE(std::abs(rows["n0.velocity"].back() + 0.43129517340650914), accuracy * 1.96);
      CHECK_LE(std::abs(rows["n1.velocity"].back() + 0.43129517340650914), accuracy * 1.96);
      CHECK_LE(std::abs(rows["n2.position"].back() + 0.7127632844320958), accuracy);
    }
  }
}

}  // namespace rheonet::test::accumulating_hops_test
