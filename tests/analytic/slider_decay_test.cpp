// A mass on a spring and a slider, let go: each half swing is one about +-Fc/k, so that the turning points come in by
// 2 Fc/k, until one lies within Fs/k. There it stays for good. With a dashpot beside it each half swing decays too.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/slider_checks.hpp"
#include "tests/analytic/sliding_motion.hpp"

namespace rheonet::test::slider_decay_test {

namespace {

constexpr double m = 1.37, k = 219.7, Fc = 1.93, stop = 3.11;
const double omega = std::sqrt(k / m), reach = Fc / k;

std::string scene(double c, double Fs, double x0, double v0, const std::string& output = "points = 301") {
  return fmt::format(R"(
[elements]
mass    = {{ type = "mass", at = "block", mass = {:.17g} }}
spring  = {{ type = "spring", between = ["ground", "block"], stiffness = {:.17g} }}
slider  = {{ type = "slider", between = ["block", "ground"], coulomb = {:.17g}, breakaway = {:.17g} }}
dashpot = {{ type = "dashpot", between = ["block", "ground"], damping = {:.17g} }}
[nodes]
block = {{ position = {:.17g}, velocity = {:.17g} }}
[simulate]
stop = {:.17g}
output = {{ {} }}
)",
                     m, k, Fc, Fs, c, x0, v0, stop, output);
}

SlidingMotion motion(double c, double Fs, double x0, double v0) {
  return SlidingMotion({m, k, c, Fc, Fs}, {{0, steady(0), 0}}, stop, x0, v0);
}

void check_motion(double c, double Fs, double x0, double v0) {
  CAPTURE(c);
  CAPTURE(Fs);
  CAPTURE(x0);
  CAPTURE(v0);
  const SlidingMotion exact = motion(c, Fs, x0, v0);
  check_at_all_accuracies(scene(c, Fs, x0, v0), {{"block.position", [&](double t) { return exact.position(t); }},
                                                 {"block.velocity", [&](double t) { return exact.velocity(t); }},
                                                 {"spring.force", [&](double t) { return -k * exact.position(t); }}});
  check_between(scene(c, Fs, x0, v0),
                {{"slider.force", [&](double t) { return exact.friction(t); }},
                 {"mass.force", [&](double t) { return m * exact.acceleration(t); }}},
                exact.instants());
  const bool overdamped = c * c >= 4 * k * m;
  const double fastest = std::max(std::abs(v0), std::abs(x0) * k / std::max(c, std::sqrt(k * m)));
  check_events(scene(c, Fs, x0, v0, "points = 2, events = true"), exact.changes(), exact.instants(),
               [&](double t, double accuracy) { return overdamped && std::abs(exact.velocity(t)) < accuracy * fastest; });
}

/// Nothing changes any more after t, to the last bit; it lies at x.
void check_stopped(const std::string& toml, double t, double x, double scale) {
  INFO(toml);
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(toml, accuracy);
    const double since = t + accuracy * stop;
    CHECK_LE(std::abs(check_constant(rows, "block.position", since) - x), 10 * accuracy * scale);
    check_exactly(rows, "block.velocity", 0, since);
    check_exactly(rows, "slider.velocity", 0, since);
    check_exactly(rows, "mass.force", 0, since);
    check_constant(rows, "spring.force", since);
    const double friction = check_constant(rows, "slider.force", since);
    CHECK_EQ(friction, doctest::Approx(-k * x).epsilon(20 * accuracy).scale(k * scale));
  }
}

}  // namespace

TEST_CASE("A mass on a spring and a slider: turning points, and where it stops") {
  // From x0 > 0 at rest: x0 - 2 n Fc/k in turn on both sides, at n pi/omega; n = 0..5 (0 is not an event).
  const double x0 = 10.63 * reach;
  std::vector<double> turns;
  for (int n = 1; n <= 5; ++n) turns.push_back(n * std::numbers::pi / omega);
  for (const double sign : {1.0, -1.0}) {
    check_events(scene(0, Fc, sign * x0, 0, "points = 2, events = true"), turns);
    check_stopped(scene(0, Fc, sign * x0, 0), turns.back(), -sign * (x0 - 10 * reach), x0);
    const RunTable rows = simulate(scene(0, Fc, sign * x0, 0, "points = 2, events = true"), 1e-9);
    std::size_t n = 0;
    double last = 0;
    for (std::size_t row = 1; row < rows.time().size(); ++row) {
      const double t = rows.time()[row];
      if (t != rows.time()[row - 1] || t == last) continue;
      last = t;
      ++n;
      const double turn = (n % 2 ? -sign : sign) * (x0 - 2 * double(n) * reach);
      CHECK_LE(std::abs(rows["block.position"][row] - turn), 1e-8 * x0);
    }
    CHECK_EQ(n, 5);
  }
}

TEST_CASE("A mass on a spring and a slider, let go") {
  for (const double Fs : {Fc, 1.53 * Fc}) {
    check_motion(0, Fs, 8.63 * reach, 0);
    check_motion(0, Fs, -7.29 * reach, 0.137);
    check_motion(0, Fs, 0, -1.117);
  }
}

TEST_CASE("A mass on a spring, a dashpot and a slider, let go") {
  for (const double zeta : {0.1, 1.0, 1.5}) {
    const double c = 2 * zeta * std::sqrt(k * m);
    check_motion(c, Fc, 23.9 * reach, 0);
    check_motion(c, Fc, -7.29 * reach, 1.137);
  }
  check_motion(0.1 * 2 * std::sqrt(k * m), 1.53 * Fc, 23.9 * reach, 0);
  const SlidingMotion exact = motion(2.71, Fc, 23.9 * reach, 0);
  REQUIRE_GE(exact.changes().size(), 3);
  REQUIRE(exact.sticks(stop));
  check_stopped(scene(2.71, Fc, 23.9 * reach, 0), exact.changes().back(), exact.position(stop), 23.9 * reach);
}

// The fourth turning point lies just within, or just beyond, what the slider holds.
TEST_CASE("A mass stops within the reach of the slider and not beyond it") {
  for (const double Fs : {Fc, 1.53 * Fc}) {
    CAPTURE(Fs);
    const double edge = 8 * reach + Fs / k;
    for (const double beside : {-0.01, 0.01}) {
      CAPTURE(beside);
      const double x0 = edge + beside * reach;
      const int swings = beside < 0 ? 4 : 5;
      const double rest = (swings % 2 ? -1 : 1) * (x0 - 2 * swings * reach), last = swings * std::numbers::pi / omega;
      for (const double accuracy : {1e-6, 1e-9}) {
        const RunTable rows = simulate(scene(0, Fs, x0, 0), accuracy);
        CHECK_LE(std::abs(check_constant(rows, "block.position", last + accuracy * stop) - rest), 10 * accuracy * x0);
      }
    }
  }
}

TEST_CASE("A mass within the reach of the slider does not move at all") {
  for (const double Fs : {Fc, 1.53 * Fc}) {
    for (const double x0 : {0.999 * Fs / k, -0.999 * Fs / k}) {
      const RunTable rows = simulate(scene(0, Fs, x0, 0), 1e-6);
      check_exactly(rows, "block.position", x0);
      check_exactly(rows, "block.velocity", 0);
      CHECK_EQ(check_constant(rows, "slider.force", 0), doctest::Approx(-k * x0).epsilon(1e-12));
    }
    for (const double x0 : {1.001 * Fs / k, -1.001 * Fs / k}) {
      const RunTable rows = simulate(scene(0, Fs, x0, 0), 1e-9);
      // Half a swing about the place where Fc holds the spring.
      const double s = x0 < 0 ? -1 : 1;
      CHECK_EQ(rows["block.position"].back(), doctest::Approx(s * 2 * reach - x0).epsilon(1e-8));
      CHECK_EQ(rows["slider.force"][1], -s * Fc);
    }
  }
}

// Energy: the initial energy of spring and mass is dissipated, except for the energy left in the spring.
TEST_CASE("Energy of a mass that comes to rest on a slider") {
  const double x0 = 10.63 * reach, rest = 0.63 * reach, way = 5 * (x0 + rest);
  const double start = k * x0 * x0 / 2, left = k * rest * rest / 2;
  CHECK_EQ(Fc * way, doctest::Approx(start - left).epsilon(1e-12));
  check_account(scene(0, Fc, x0, 0), {0, left - start, start - left});
}

}  // namespace rheonet::test::slider_decay_test
