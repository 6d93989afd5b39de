// The positions of the nodes of a gear keep its ratio. They were integrated, each with an error of its own, also where they follow from each other and from
// given motions: the ends of a gear that turns as one moved apart by that error.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::positions_at_gears_test {

namespace {

constexpr double A = 0.63, f = 2.2, x0 = 0.01, ratio = 0.6;
constexpr double roundoff = 1e-15;

/// Position of the driven node [m].
double x(double t) { return A * (1 - std::cos(2 * std::numbers::pi * f * t)) / (2 * std::numbers::pi * f); }

RunTable run(const std::string& elements, const std::string& nodes = "") {
  return simulate(fmt::format(R"([elements]
drive = {{ type = "motion", at = "end", velocity = {{ sine = {}, frequency = {} }} }}
{}
{}[simulate]
stop = 1.1
accuracy = 1e-3
method = "ida"
output = {{ points = 41 }}
)",
                              A, f, elements, nodes));
}

}  // namespace

TEST_CASE("a gear that a brake locks turns as one") {
  const RunTable rows = run(R"(gear = { type = "gear", between = ["end", "n"], ratio = 0.6, support = "s" }
brake = { type = "slider", between = ["s", "end"], coulomb = 50 }
friction = { type = "cfm", between = ["n", "ground"], stiffness = 20, damping = 1, coulomb = 0.5 }
m_n = { type = "mass", at = "n", mass = 0.05 }
m_s = { type = "mass", at = "s", mass = 0.03 })");
  for (const double way : rows["gear.displacement"]) CHECK(std::abs(way) <= roundoff);
  for (std::size_t i = 0; i < rows.time().size(); ++i) CHECK(std::abs(rows["n.position"][i] - x(rows.time()[i])) <= roundoff);
}

TEST_CASE("a node between two given motions has the position that a planetary gear gives it") {
  const RunTable rows = run(R"(other = { type = "motion", at = "s", velocity = 0.371 }
gear = { type = "gear", between = ["n", "end"], ratio = 0.6, support = "s" }
friction = { type = "cfm", between = ["n", "ground"], stiffness = 20, damping = 1, coulomb = 0.5 }
m_n = { type = "mass", at = "n", mass = 0.05 })",
                            "[nodes]\nn = { position = 0.01 }\n");
  for (std::size_t i = 0; i < rows.time().size(); ++i) {
    const double t = rows.time()[i];
    CHECK(std::abs(rows["n.position"][i] - (x0 + ratio * x(t) + (1 - ratio) * 0.371 * t)) <= roundoff);
  }
}

// In the second scene everything moves with its support: the gear locks the node to it, and both are in one place after any time.
TEST_CASE("a node that a gear holds at its support stays there") {
  for (const double v : {0.0, 0.371}) {
    const RunTable rows = run(fmt::format(R"(base = {{ type = "motion", at = "base", velocity = {} }}
gear = {{ type = "gear", between = ["base", "n"], ratio = 0.52, support = "s" }}
brake = {{ type = "slider", between = ["n", "s"], coulomb = 50 }}
spring = {{ type = "spring", between = ["s", "end"], stiffness = 3 }}
oil = {{ type = "vfm", between = ["n", "end"], stiffness = 10, damping = 1 }}
m_n = {{ type = "mass", at = "n", mass = 0.05 }}
m_s = {{ type = "mass", at = "s", mass = 0.03 }})",
                                          v),
                              fmt::format("[nodes]\nn = {{ velocity = {} }}\ns = {{ velocity = {} }}\n", v, v));
    for (std::size_t i = 0; i < rows.time().size(); ++i) CHECK(std::abs(rows["n.position"][i] - v * rows.time()[i]) <= roundoff);
  }
}

}  // namespace rheonet::test::positions_at_gears_test
