// Motions whose acceleration is given: it is integrated from the start velocity and position of the node.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"
#include "tests/support/response.hpp"

using namespace rheonet::test;

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
