// Where a slider sticks a position follows along it; where it slips, from that of a neighbour that nobody asked for. That one was
// then not known, and taken to be where it began: the slider jumped as it broke away.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::position_beside_unasked_test {

TEST_CASE("regression: a slider that breaks away begins where it was, whatever else is recorded") {
  const std::string scene = R"([elements]
drive = { type = "force", at = "end", force = { sine = 0.88, frequency = 2.19 } }
e1 = { type = "slider", between = ["end", "n1"], coulomb = 0.62 }
e2 = { type = "vfm", between = ["n1", "n2"], stiffness = 60, damping = 0.56 }
e3 = { type = "spring", between = ["ground", "n2"], stiffness = 7.2 }
e4 = { type = "vfm", between = ["end", "n3"], stiffness = 36, damping = 1.64 }
e5 = { type = "spring", between = ["n3", "ground"], stiffness = 21.6 }
m1 = { type = "mass", at = "n1", mass = 0.083 }
m2 = { type = "mass", at = "n2", mass = 0.024 }
[simulate]
stop = 1
output = { points = 61, events = true }
record = [)";
  const RunTable alone = simulate(scene + "\"e1.displacement\"]\n", 1e-7);
  const RunTable all = simulate(scene + "\"e1.displacement\", \"end.position\", \"n1.position\", \"n2.position\", \"n3.position\"]\n", 1e-7);
  const auto &d = alone["e1.displacement"], &end = all["end.position"], &n1 = all["n1.position"];
  REQUIRE_EQ(d.size(), end.size());
  double largest = 0, apart = 0;
  int events = 0;
  for (std::size_t row = 0; row < d.size(); ++row) {
    largest = std::max(largest, std::abs(d[row]));
    apart = std::max(apart, std::abs(d[row] - (end[row] - n1[row])));
    if (row == 0 || alone.time()[row] > alone.time()[row - 1]) continue;
    ++events;
    CHECK(std::abs(d[row] - d[row - 1]) <= 1e-9);
  }
  CHECK_GE(events, 4);
  CHECK_GT(largest, 0.01);
  CHECK(apart <= 1e-6 * largest);
}

}  // namespace rheonet::test::position_beside_unasked_test
