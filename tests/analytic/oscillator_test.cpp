// Mass, spring and dashpot: m x'' + c x' + k x = F, with c = 2 zeta sqrt(k m), on both sides of zeta = 1 and at it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"

using namespace rheonet::test;

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
