#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "tests/support/simulate.hpp"

namespace rheonet::test::prandtl_beyond_its_bound_test {

// So stiff that the last digit of the displacement is a force: where the law yields the event is found so much too late, and
// the force went beyond the bound.
TEST_CASE("Prandtl's law of 1e12 N/m does not go beyond its bound") {
  const RunTable rows = simulate(R"([elements]
drive = { type = "motion", at = "shaft", position = { triangle = 0.7, frequency = 1.3, offset = 0.4 } }
i0 = { type = "sfm", between = ["shaft", "ground"], stiffness = 1e12, coulomb = 1.3, exponent = 0 }
[nodes]
shaft = { position = 0.4 }
[simulate]
stop = 2
output = { points = 101, events = true }
record = ["i0.force"]
)");
  const auto [least, most] = std::minmax_element(rows["i0.force"].begin(), rows["i0.force"].end());
  CHECK(*most == 1.3);
  CHECK(*least == -1.3);
}

}  // namespace rheonet::test::prandtl_beyond_its_bound_test
