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

}  // namespace rheonet::test::accumulating_hops_test
