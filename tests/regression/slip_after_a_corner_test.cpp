#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "tests/support/simulate.hpp"

namespace rheonet::test::slip_after_a_corner_test {

// At a corner of its motion a drive has, to an ulp, another velocity than a moment before. A mass that stuck to it seemed to slip by that ulp,
// which hid that it broke away: it was held by 0.4 % more than its friction.
TEST_CASE("a mass that breaks away from its drive at a corner, in any units") {
  for (const double length : {1.0, 1e-3, 1e-8, 1e-9}) {
    for (const double force : {1.0, 1e9}) {
      CAPTURE(length);
      CAPTURE(force);
      const double coulomb = 1.0099342267165048 * force;
      const RunTable rows = simulate(fmt::format(R"([elements]
drive = {{ type = "motion", at = "end", velocity = {{ triangle = {:.17g}, frequency = 3.141030643744472 }} }}
e1 = {{ type = "slider", between = ["n1", "end"], coulomb = {:.17g} }}
e2 = {{ type = "spring", between = ["n1", "n2"], stiffness = {:.17g} }}
e3 = {{ type = "slider", between = ["n2", "ground"], coulomb = {:.17g}, breakaway = {:.17g} }}
m_n1 = {{ type = "mass", at = "n1", mass = {:.17g} }}
m_n2 = {{ type = "mass", at = "n2", mass = {:.17g} }}
[simulate]
stop = 0.9212941948274687
accuracy = 1e-6
output = {{ points = 61, events = true }}
)",
                                                 -0.7554491186760415 * length, coulomb, 11.240104943943521 * force / length, 0.45755174833862294 * force,
                                                 0.5804608942527085 * force, 0.0868749693038275 * force / length, 0.08143161326554448 * force / length));
      for (const double f : rows["e1.force"]) CHECK_LE(std::abs(f), coulomb * (1 + 1e-12));
      CHECK(rows["e1.displacement"].back() == doctest::Approx(0.000123688508656 * length).epsilon(1e-8));
    }
  }
}

}  // namespace rheonet::test::slip_after_a_corner_test
