#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::far_kink_test {

// Where the load has a corner the velocities are looked for anew. Two ends that move alike but for rounding meet after 10^21 of
// a step: from there back the search never came to the solution, and friction held at its bound was let go, over and over.
TEST_CASE("friction held at its bound stays there over a corner of its load") {
  const double Fc = 1.14, B = 16.3;
  const rheonet::test::RunTable run = rheonet::test::simulate(R"([elements]
e1 = { type = "cfm", between = ["n0", "ground"], stiffness = 22.5, coulomb = 0.752, damping = 5.46, exponent = 1 }
e2 = { type = "cfm", between = ["n1", "n0"], stiffness = 62.8, coulomb = 1.14, damping = 16.3, exponent = 0.5 }
e3 = { type = "dashpot", between = ["n0", "ground"], damping = 0.23, flow_index = 0.5 }
e4 = { type = "dashpot", between = ["n1", "n0"], damping = 16, flow_index = 2 }
m0 = { type = "mass", at = "n0", mass = 0.106 }
f = { type = "force", at = "n1", force = { table = [[0, 0], [0.5, 2.77], [1.1, -2.77]] } }
[simulate]
stop = 0.8
accuracy = 1e-6
output = { points = 81 }
)");
  int held = 0;
  for (std::size_t i = 0; i < run.time().size(); ++i) {
    CHECK(std::abs(run["e2.force"][i] + run["e4.force"][i] - run["f.force"][i]) < 1e-5);
    if (run.time()[i] < 0.4 || !(run["e2.velocity"][i] > 1.001 * Fc / B)) continue;
    ++held;
    CHECK(run["e2.force"][i] == doctest::Approx(Fc).epsilon(1e-9));
  }
  CHECK(held > 20);
}

}  // namespace rheonet::test::far_kink_test
