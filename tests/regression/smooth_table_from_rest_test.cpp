// A smooth table that begins with rate and curvature 0: the round-off of its curvature would move it backwards first.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::smooth_table_from_rest_test {

TEST_CASE("a motion along a smooth table that begins at rest, with friction that depends on the velocity") {
  const RunTable rows = simulate(R"([elements]
e = { type = "motion", at = "a", position = { table = [[0, 0], [0.5, 0.2], [1, 1], [2, 0]], smooth = true } }
s = { type = "slider", between = ["a", "ground"], coulomb = 0.5, stribeck = 0.1, peak = 2 }
[simulate]
stop = 2
)", 1e-9);
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    const double t = rows.time()[row], v = rows["a.velocity"][row];
    CAPTURE(t);
    // It begins as t^3, and is monotone between its points.
    if (t > 0 && t < 1) CHECK(v > 0);
    if (t > 1 && t < 2) CHECK(v < 0);
    if (v != 0) CHECK_LE(std::abs(rows["s.force"][row] - std::copysign(0.5 * (1 + std::exp(-(v / 0.1) * (v / 0.1))), v)), 1e-9);
  }
}

}  // namespace rheonet::test::smooth_table_from_rest_test
