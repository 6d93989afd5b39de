// Errors of steps that add up: what oscillates undamped keeps its phase all the same, and what forgets them is not asked for
// steps as if it did not.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::global_error_model_test {

namespace {

constexpr double m = 0.7, k = 90, x0 = 1.3;

/// An oscillator that is let go at x0, in so many of its cycles; `beside` are more elements.
std::string oscillator(int cycles, const std::string& beside = "") {
  return fmt::format(R"(
[elements]
m1 = {{ type = "mass", at = "a", mass = {} }}
k1 = {{ type = "spring", between = ["a", "ground"], stiffness = {} }}
{}
[nodes]
a = {{ position = {} }}
[simulate]
stop = {}
output = {{ points = 501 }}
)", m, k, beside, x0, (cycles + 0.3) * 2 * M_PI * std::sqrt(m / k));
}

/// The largest error of its position, as a share of x0.
double error(const RunTable& rows) {
  double off = 0;
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    off = std::max(off, std::abs(rows["a.position"][row] - x0 * std::cos(std::sqrt(k / m) * rows.time()[row])));
  }
  return off / x0;
}

long steps(const std::string& toml, double accuracy) {
  Summary summary;
  simulate(scene_of(toml, accuracy), &summary);
  return summary.steps;
}

}  // namespace

TEST_CASE("an undamped oscillation is as accurate after many cycles as after one") {
  for (const int cycles : {1, 30, 300}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(cycles);
      CAPTURE(accuracy);
      const double off = error(simulate(oscillator(cycles), accuracy));
      CHECK(off <= accuracy);
      CHECK(off > 0);
    }
  }
}

// A hundred thousand steps, each of which rounds the time: to 1e-14 s at the end.
TEST_CASE("time does not go astray by the rounding of its sums") {
  CHECK(error(simulate(oscillator(500), 1e-9)) <= 1e-9);
}

TEST_CASE("a part of the network that oscillates is noticed beside another that turns far more energy into heat") {
  const std::string heater = R"(
m2 = { type = "mass", at = "b", mass = 0.2 }
c2 = { type = "dashpot", between = ["b", "ground"], damping = 40 }
f2 = { type = "force", at = "b", force = { sine = 900, frequency = 0.3 } }
)";
  CHECK(error(simulate(oscillator(40, heater), 1e-8)) <= 1e-8);
}

TEST_CASE("what forgets its errors is not asked for shorter steps the longer it runs") {
  // Driven for twenty times as long a damped oscillator takes twenty times the steps, an undamped one some more.
  const auto driven = [](double damping, int cycles) {
    return fmt::format(R"(
[elements]
m1 = {{ type = "mass", at = "a", mass = {} }}
k1 = {{ type = "spring", between = ["a", "ground"], stiffness = {} }}
c1 = {{ type = "dashpot", between = ["a", "ground"], damping = {} }}
f1 = {{ type = "force", at = "a", force = {{ sine = 5, frequency = 2.1 }} }}
[simulate]
method = "ida"
stop = {}
)", m, k, damping, cycles / 2.1);
  };
  const auto growth = [&](double damping) {
    return static_cast<double>(steps(driven(damping, 800), 1e-6)) / static_cast<double>(steps(driven(damping, 40), 1e-6));
  };
  const double damped = growth(3.0), undamped = growth(1e-6);
  CHECK(damped < 22);
  CHECK(undamped > 25);
}

/// A ball that flies between two elastic walls at +-way, for `stop` [s].
std::string ball(double way, double stiffness, double speed, double stop) {
  return fmt::format(R"(
[elements]
ball = {{ type = "mass", at = "a", mass = {} }}
walls = {{ type = "stop", between = ["a", "ground"], lower = {}, upper = {}, stiffness = {} }}
[nodes]
a = {{ velocity = {} }}
[simulate]
method = "ida"
stop = {}
output = {{ points = 2001 }}
)", m, -way, way, stiffness, speed, stop);
}

// A wall turns it in a seventh of the time that it flies, so a record changes fast beside a delay of the flight.
TEST_CASE("impacts after long flights come when they should") {
  const double stiffness = 3e4, way = 0.06, speed = 1.3;
  const double omega = std::sqrt(stiffness / m), flight = 2 * way / speed, touch = M_PI / omega;
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    const RunTable rows = simulate(ball(way, stiffness, speed, 0.5), accuracy);
    const double off = error_of(rows, "a.velocity", [&](double t) {
      const double since_wall = t + flight / 2, turns = std::floor(since_wall / (flight + touch));
      const double deep = std::max(since_wall - turns * (flight + touch) - flight, 0.0);
      return speed * std::cos(omega * deep) * (std::fmod(turns, 2) == 0 ? 1 : -1);
    });
    CHECK(off <= 10 * accuracy);
  }
}

// A turn takes 5 ms of 460 ms: the round-off of time, times the acceleration there, is no error of a step.
TEST_CASE("elastic impacts late in a run keep the velocity") {
  const double speed = 1.3;
  const RunTable rows = simulate(ball(0.3, 3e5, speed, 5), 1e-9);
  double off = 0;
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    if (rows["walls.force"][row] == 0) off = std::max(off, std::abs(std::abs(rows["a.velocity"][row]) / speed - 1));
  }
  CHECK(off <= 1e-10);
}

}  // namespace rheonet::test::global_error_model_test
