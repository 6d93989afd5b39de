// A mass that a pseudoplastic dashpot alone slows down comes to rest at a finite time, and the force falls to 0 there with a
// slope without bound where the exponent is below 1/2.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/check.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::power_law_stops_test {

namespace {

constexpr double m = 2.03, B = 0.71, v0 = 1.13;

/// m v' = -B v^n: v^(1-n) falls linearly.
struct Stopping {
  double n;
  double at_rest() const { return m * std::pow(v0, 1 - n) / ((1 - n) * B); }
  double velocity(double t) const { return std::pow(std::max(0.0, std::pow(v0, 1 - n) - (1 - n) * B * t / m), 1 / (1 - n)); }
  double force(double t) const { return B * std::pow(velocity(t), n); }
};

}  // namespace

TEST_CASE("a pseudoplastic dashpot brings a mass to rest: its force is as close as it is asked for, up to there and after") {
  for (const double n : {0.3, 0.4, 0.5, 0.7}) {
    const Stopping exact{n};
    for (const double accuracy : {1e-2, 1e-3, 1e-6, 1e-9}) {
      CAPTURE(n);
      CAPTURE(accuracy);
      SceneBuilder b;
      b.at("m", "mass", "a", {{"mass", m}});
      b.between("c", "dashpot", "ground", "a", {{"damping", B}, {"flow_index", n}});
      b.start("a", 0.2, -v0);
      const RunTable run = simulate(b.finish(1.2 * exact.at_rest(), 2000, accuracy));
      check_against(run, {"c.force", [&](double t) { return exact.force(t); }}, accuracy);
      check_against(run, {"a.velocity", [&](double t) { return -exact.velocity(t); }}, accuracy);
      check_against(run, {"m.force", [&](double t) { return exact.force(t); }}, accuracy);
    }
  }
}

// The same between two masses, seen from their centre of mass, which goes on.
TEST_CASE("a pseudoplastic dashpot brings two masses to rest against each other") {
  constexpr double m1 = 3.3, m2 = m * m1 / (m1 - m);  // together they resist as m does
  for (const double n : {0.35, 0.6}) {
    const Stopping exact{n};
    for (const double accuracy : {1e-3, 1e-6}) {
      CAPTURE(n);
      CAPTURE(accuracy);
      SceneBuilder b;
      b.at("m1", "mass", "a", {{"mass", m1}});
      b.at("m2", "mass", "b", {{"mass", m2}});
      b.between("c", "dashpot", "a", "b", {{"damping", B}, {"flow_index", n}});
      b.start("a", 0, v0 + 0.4);
      b.start("b", 0, 0.4);
      const RunTable run = simulate(b.finish(1.2 * exact.at_rest(), 500, accuracy));
      check_against(run, {"c.force", [&](double t) { return exact.force(t); }}, accuracy);
      const double both = 0.4 + v0 * m1 / (m1 + m2);
      check_against(run, {"b.velocity", [&](double t) { return both - exact.velocity(t) * m1 / (m1 + m2); }}, accuracy);
    }
  }
}

// In series two of the same exponent are one: w = (f/B1)^(1/n) + (f/B2)^(1/n).
TEST_CASE("pseudoplastic dashpots in series bring a mass to rest") {
  for (const double n : {0.35, 0.6}) {
    const Stopping exact{n};
    const double B1 = 1.7, B2 = std::pow(std::pow(B, -1 / n) - std::pow(B1, -1 / n), -n);
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(n);
      CAPTURE(accuracy);
      SceneBuilder b;
      b.at("m", "mass", "a", {{"mass", m}});
      b.between("c1", "dashpot", "a", "b", {{"damping", B1}, {"flow_index", n}});
      b.between("c2", "dashpot", "b", "ground", {{"damping", B2}, {"flow_index", n}});
      b.start("a", 0.2, v0);
      const RunTable run = simulate(b.finish(1.2 * exact.at_rest(), 1000, accuracy));
      for (const char* force : {"c1.force", "c2.force"}) check_against(run, {force, [&](double t) { return exact.force(t); }}, accuracy);
      check_against(run, {"a.velocity", [&](double t) { return exact.velocity(t); }}, accuracy);
    }
  }
}

}  // namespace rheonet::test::power_law_stops_test
