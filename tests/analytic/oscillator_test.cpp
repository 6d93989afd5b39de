// Mass, spring and dashpot: m x'' + c x' + k x = F, with c = 2 zeta sqrt(k m), on both sides of zeta = 1 and at it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::oscillator_test {

namespace {

constexpr double m = 1.73, k = 219.7, stop = 1.117;
constexpr double ratios[] = {0, 0.1, 1, 1.5};

std::string scene(double zeta, const std::string& tables) {
  std::string elements = R"(
[elements.mass]
type = "mass"
at = "end"
mass = "m"
[elements.spring]
type = "spring"
between = ["end", "ground"]
stiffness = "k"
)";
  if (zeta > 0) {
    elements += R"toml(
[elements.dashpot]
type = "dashpot"
between = ["ground", "end"]
damping = "2*zeta*sqrt(k*m)"
)toml";
  }
  return netlist({{"m", m}, {"k", k}, {"zeta", zeta}}, tables + elements, stop);
}

/// The motion under a force F, from x0 and v0.
Response motion(double zeta, const Response& force, double x0, double v0) {
  const Response::Complex root = std::sqrt(Response::Complex(zeta * zeta - 1)), omega = std::sqrt(k / m);
  return (force / k).second_order(omega * (zeta + root), omega * (zeta - root), x0, v0);
}

void check(double zeta, const std::string& tables, const Response& x, double start) {
  const Response v = x.derivative();
  const double c = 2 * zeta * std::sqrt(k * m);
  Expectations expected = {
      {"end.position", from(start, x)},     {"end.velocity", from(start, v)},
      {"spring.force", from(start, k * x)}, {"mass.force", from(start, m * v.derivative())},
      {"mass.velocity", from(start, v)},
  };
  if (zeta > 0) {
    expected.push_back({"dashpot.force", from(start, -c * v)});
    expected.push_back({"dashpot.displacement", from(start, -1.0 * x)});
  }
  CAPTURE(zeta);
  check_at_all_accuracies(scene(zeta, tables) + record(expected), expected);
}

}  // namespace

TEST_CASE("Oscillator, free") {
  const double x0 = 0.0317, v0 = -0.841;
  for (const double zeta : ratios) {
    check(zeta, fmt::format("[nodes]\nend = {{ position = {}, velocity = {} }}\n", x0, v0),
          motion(zeta, Response(), x0, v0), 0);
    check(zeta, fmt::format("[nodes]\nend = {{ position = {} }}\n", x0), motion(zeta, Response(), x0, 0), 0);
    check(zeta, fmt::format("[nodes]\nend = {{ velocity = {} }}\n", v0), motion(zeta, Response(), 0, v0), 0);
  }
}

TEST_CASE("Oscillator, forced") {
  for (const double zeta : ratios) {
    for (const Load& load : loads()) {
      CAPTURE(load.name);
      check(zeta, load.element, motion(zeta, load.force, 0, 0), drive_start);
    }
  }
}

TEST_CASE("Oscillator, on a spring so soft that the run ends within a small part of a period") {
  // The force of the spring is far below the round-off of the others: its displacement counts all the same.
  const double mass = 2.3, force = 4.1, end = 1.3;
  for (const double soft : {1e-30, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(soft);
      CAPTURE(accuracy);
      const RunTable rows = simulate(fmt::format(R"~(
[elements]
m = {{ type = "mass", at = "a", mass = {} }}
F = {{ type = "force", at = "a", force = {} }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = {} }}
)~", mass, force, soft) + simulate_until(end, accuracy));
      // 2 F/k sin(w t/2)^2, where w t/2 may be small.
      const double omega = std::sqrt(soft / mass);
      const auto position = [&](double t) {
        const double half = omega * t / 2, sinc = half > 1e-6 ? std::sin(half) / half : 1;
        return force * t * t / (2 * mass) * sinc * sinc;
      };
      CHECK(error_of(rows, "a.position", position) < accuracy);
      CHECK(error_of(rows, "k.force", [&](double t) { return soft * position(t); }) < accuracy);
      CHECK(error_of(rows, "a.velocity", [&](double t) { return force / (mass * omega) * std::sin(omega * t); }) < accuracy);
    }
  }
}

}  // namespace rheonet::test::oscillator_test
