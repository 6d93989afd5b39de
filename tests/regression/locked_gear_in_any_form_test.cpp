// Brakes that lock a gear share a load with it by the least sum of squares. A gear on ground is computed as a change of units, and the squares were those
// of forces in these units; one on a support that could move is an equation, and there they were those of the forces themselves.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::locked_gear_in_any_form_test {

namespace {

constexpr double F = 0.8;

/// A force on the first node of a gear, and a brake at each of its nodes. The support is ground, or a node that could move.
std::string scene(double ratio, double bound, bool at_ground) {
  const std::string base = at_ground ? "ground" : "base";
  return fmt::format(R"([elements]
load = {{ type = "force", at = "a", force = {} }}
gear = {{ type = "gear", between = ["a", "b"], ratio = {}{} }}
first = {{ type = "slider", between = ["a", "{}"], coulomb = {} }}
second = {{ type = "slider", between = ["b", "{}"], coulomb = 5 }}
m_a = {{ type = "mass", at = "a", mass = 0.1 }}
m_b = {{ type = "mass", at = "b", mass = 0.2 }}
{}[simulate]
stop = 0.1
)",
                     F, ratio, at_ground ? "" : ", support = \"base\"", base, bound, base, at_ground ? "" : "held = { type = \"motion\", at = \"base\", velocity = 0 }\n");
}

}  // namespace

// With the force g of the gear at its first node, the brakes take F - g and ratio g: the sum of squares of all three is least at g = F / (2 + ratio^2).
TEST_CASE("brakes share a load with the gear that they lock, in whichever form it is computed") {
  for (const double i : {1.4, -2.5, 0.3}) {
    const double shared = F / (2 + i * i);
    for (const double bound : {5.0, 0.8 * (F - shared)}) {
      const double gear = std::max(shared, F - bound);
      for (const bool at_ground : {true, false}) {
        CAPTURE(i);
        CAPTURE(bound);
        CAPTURE(at_ground);
        const RunTable rows = simulate(scene(i, bound, at_ground));
        CHECK(std::abs(rows["first.force"].back()) == doctest::Approx(F - gear).epsilon(1e-12));
        CHECK(std::abs(rows["second.force"].back()) == doctest::Approx(std::abs(i) * gear).epsilon(1e-12));
        CHECK(std::abs(rows["gear.force"].back()) == doctest::Approx(gear).epsilon(1e-12));
      }
    }
  }
}

}  // namespace rheonet::test::locked_gear_in_any_form_test
