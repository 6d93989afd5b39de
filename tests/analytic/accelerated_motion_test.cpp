// Motions whose acceleration is given: it is integrated from the start velocity and position of the node.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/netlist/signal.hpp"
#include "tests/support/check.hpp"
#include "tests/support/response.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::accelerated_motion_test {

namespace {

constexpr double x0 = 0.0317, v0 = -0.841, stop = 1.117;
constexpr double A = 7.31, frequency = 2.9, omega = 2 * std::numbers::pi * frequency;

std::string scene(const std::string& acceleration, const std::string& elements) {
  return netlist({}, fmt::format(R"(
[nodes]
end = {{ position = {}, velocity = {} }}
[elements]
drive = {{ type = "motion", at = "end", acceleration = {} }}
{})", x0, v0, acceleration, elements), stop);
}

}  // namespace

TEST_CASE("a motion by acceleration moves its node, and a mass there takes m a") {
  const double m = 1.73, k = 219.7;
  const auto check = [&](const std::string& signal, const Response& a, const std::string& more = "") {
    CAPTURE(signal);
    const Response v = a.integral(v0), x = v.integral(x0);
    const Expectations expected = {{"end.position", x}, {"end.velocity", v}, {"spring.force", k * x}, {"mass.force", m * a},
                                   {"drive.force", m * a + k * x}};
    check_at_all_accuracies(scene(signal, more + fmt::format(R"(mass   = {{ type = "mass", at = "end", mass = {} }}
spring = {{ type = "spring", between = ["end", "ground"], stiffness = {} }}
)", m, k)) + record(expected), expected);
  };
  check(fmt::format("{{ sine = {}, frequency = {} }}", A, frequency), A * Response::sine(1, omega));
  check(fmt::format("{{ ramp = {} }}", A), Response::ramp(A));
  check("-1.37", Response::constant(-1.37));
  check(R"({ block = "g" })", Response::ramp(0.83), R"(g = { type = "generator", signal = { ramp = "0.83 m/s^3" } })" "\n");
}

// By Gauss's rule with three points in short panels, none of which goes over an end of a piece.
TEST_CASE("a motion by acceleration is the exact integral of its signal, however long and however loose the run") {
  const auto moved = [](const rheonet::Signal& a, double t) {
    double velocity = 0, way = 0;  // their integrals, the second one of (t - u) a(u)
    for (double u = 0; u < t;) {
      const rheonet::Piece piece = a.piece(u);
      const double end = std::min({t, piece.end, u + 0.002}), half = (end - u) / 2, middle = (end + u) / 2;
      for (const auto& [x, weight] : {std::pair{-std::sqrt(0.6), 5.0 / 9}, {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}}) {
        const double at = middle + half * x, value = weight * half * piece.value(at);
        velocity += value;
        way += (t - at) * value;
      }
      u = end;
    }
    return std::pair(velocity, way);
  };
  for (const char* signal : {"0.37", "{ step = 1.3, time = 0.71, offset = -0.2 }", "{ ramp = 0.7, time = 0.4 }", "{ sine = 7.31, frequency = 2.9, phase = 0.4, time = 0.13 }",
                             "{ sine = 7.31, frequency = 1e-9, phase = 0.4 }", "{ square = 1.1, frequency = 0.83 }", "{ triangle = 1.1, frequency = 0.83, phase = 0.3 }",
                             "{ pulse = 1.4, width = 0.3, frequency = 0.47, time = 0.2 }", "{ chirp = 2.1, frequency = 0.7, end_frequency = 5, duration = 3, phase = 0.2, time = 0.5 }",
                             "{ chirp = 2.1, frequency = 3, end_frequency = 0.01, duration = 3 }", "{ table = [[0, 0.3], [1, 2], [2.2, 2], [3, -1.7], [5, 0.4]] }",
                             "{ table = [[0, 0.3], [1, 2], [2.2, 2], [3, -1.7], [5, 0.4]], smooth = true, time = 0.3 }", "{ noise = 1.2, seed = 3, interval = 0.13 }"}) {
    CAPTURE(std::string(signal));
    for (const double accuracy : {1e-3, 1e-9}) {
      const rheonet::Scene of = scene_of(fmt::format(R"([nodes]
end = {{ position = {}, velocity = {} }}
[elements]
drive = {{ type = "motion", at = "end", acceleration = {} }}
spring = {{ type = "spring", between = ["end", "top"], stiffness = 3 }}
mass = {{ type = "mass", at = "top", mass = 1 }}
[simulate]
stop = 7
accuracy = {}
output = {{ points = 15 }}
record = ["end.position", "end.velocity", "top.position"]
)", x0, v0, signal, accuracy));
      const RunTable rows = simulate(of);
      for (std::size_t n = 0; n < rows.time().size(); ++n) {
        const double t = rows.time()[n];
        const auto [velocity, way] = moved(of.elements.front().signals.at(0), t);
        CHECK(std::abs(rows["end.velocity"][n] - (v0 + velocity)) <= 1e-12 * rows.scale("end.velocity"));
        CHECK(std::abs(rows["end.position"][n] - (x0 + v0 * t + way)) <= 1e-12 * (1 + rows.scale("end.position")));
      }
    }
  }
  const double t = 1000, way = A / omega * t - A / (omega * omega) * std::sin(omega * t);
  const RunTable rows = simulate(fmt::format("[elements]\ndrive = {{ type = \"motion\", at = \"end\", acceleration = {{ sine = {}, frequency = {} }} }}\n"
                                             "[simulate]\nstop = {}\naccuracy = 1e-6\noutput = {{ points = 2 }}\n", A, frequency, t));
  CHECK(std::abs(rows["end.position"][1] - way) <= 1e-12 * way);
}

// Seen from the base, the inertia of the mass is a force -m a.
TEST_CASE("an accelerated base shakes an oscillator as a force on its mass does") {
  const double m = 1.73, k = 219.7, zeta = 0.13, c = 2 * zeta * std::sqrt(k * m), natural = std::sqrt(k / m);
  const Response::Complex root = std::sqrt(Response::Complex(zeta * zeta - 1));
  const Response seen = (-m / k * A * Response::sine(1, omega)).second_order(natural * (zeta + root), natural * (zeta - root), 0, 0);
  const Expectations expected = {{"spring.displacement", seen}, {"spring.force", k * seen}, {"dashpot.velocity", seen.derivative()}};
  check_at_all_accuracies(netlist({}, fmt::format(R"(
[elements]
base    = {{ type = "motion", at = "base", acceleration = {{ sine = {}, frequency = {} }} }}
mass    = {{ type = "mass", at = "top", mass = {} }}
spring  = {{ type = "spring", between = ["top", "base"], stiffness = {} }}
dashpot = {{ type = "dashpot", between = ["top", "base"], damping = {:.17g} }}
)", A, frequency, m, k, c), stop) + record(expected), expected);
}

// The base oscillates about one place. An error of its velocity, made early, moves its position until the end.
TEST_CASE("a base that a function accelerates to and fro for long ends where it should") {
  const double a = 3, w = 7, longer = 60;
  const std::string toml = fmt::format(R"toml(
[elements]
waves   = {{ type = "function", out = "{} * cos({}*t)" }}
base    = {{ type = "motion", at = "base", acceleration = {{ block = "waves" }} }}
mass    = {{ type = "mass", at = "top", mass = 1 }}
spring  = {{ type = "spring", between = ["top", "base"], stiffness = 90 }}
dashpot = {{ type = "dashpot", between = ["top", "base"], damping = 2 }}
[simulate]
stop   = {}
record = ["base.position"]
output = {{ points = 801 }}
)toml", a, w, longer);
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    const RunTable rows = simulate(toml, accuracy);
    double worst = 0;
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      worst = std::max(worst, std::abs(rows["base.position"][row] - a / (w * w) * (1 - std::cos(w * rows.time()[row]))));
    }
    CHECK(worst <= 2 * accuracy * (2 * a / (w * w)));
  }
}

TEST_CASE("friction on an accelerated base slips where the acceleration exceeds Fc/m") {
  const double m = 1.73, Fc = 2.37;
  for (const double share : {0.98, 1.02}) {
    const double a = share * Fc / m;
    const Expectations expected = {{"top.velocity", [=](double t) { return std::min(a, Fc / m) * t; }},
                                   {"friction.force", [=](double) { return -std::min(m * a, Fc); }}};
    check_at_all_accuracies(netlist({}, fmt::format(R"(
[elements]
base     = {{ type = "motion", at = "base", acceleration = {:.17g} }}
mass     = {{ type = "mass", at = "top", mass = {} }}
friction = {{ type = "slider", between = ["top", "base"], coulomb = {} }}
)", a, m, Fc), stop) + record(expected), expected);
  }
}

}  // namespace rheonet::test::accelerated_motion_test
