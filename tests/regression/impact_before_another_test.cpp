// Two bodies are pushed back from a floor that gives all energy back; the lower one just reaches it, the upper one is faster.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::impact_before_another_test {

// The lower body just touches the floor 3 ms before the upper one meets it, within one step. Whether the floor was noticed depended on where the step ended.
TEST_CASE("an impact just before another one is found wherever the run ends") {
  const double x = 0.607477, v = -4.92942, g = 20, met = (-v - std::sqrt(v * v - 2 * g * x)) / g;
  for (const double stop : {0.40, 0.47, 0.51, 0.519, 0.53, 0.55, 0.6, 1.0}) {
    CAPTURE(stop);
    const RunTable rows = simulate(fmt::format(R"(
[elements]
m1 = {{ type = "mass", at = "x1", mass = 1 }}
m2 = {{ type = "mass", at = "x2", mass = 1 }}
g1 = {{ type = "force", at = "x1", force = 20 }}
g2 = {{ type = "force", at = "x2", force = 20 }}
floor = {{ type = "stop", between = ["x1", "ground"], lower = 0, stiffness = "inf", restitution = 1 }}
gap = {{ type = "stop", between = ["x2", "x1"], lower = 0, stiffness = "inf", restitution = 1 }}
[nodes]
x1 = {{ position = 0.607477, velocity = -4.92942 }}
x2 = {{ position = 1.607477, velocity = -8.94896 }}
[simulate]
stop = {}
record = ["x1.velocity"]
output = {{ points = 501 }}
)", stop));
    int between = 0;
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      const double t = rows.time()[row];
      if (t <= met || t >= 0.2487) continue;
      ++between;
      CHECK(std::abs(rows["x1.velocity"][row] - (std::sqrt(v * v - 2 * g * x) + g * (t - met))) <= 1e-5 * std::abs(v));
    }
    CHECK(between > 0);
  }
}

}  // namespace rheonet::test::impact_before_another_test
