#include <doctest/doctest.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::slow_beside_fast_test {

// At each event velocities below 1e-14 of the fastest were taken for rounding, and a mass that was so slow stopped.
TEST_CASE("what is slow is not stopped by an event where others are fast") {
  const RunTable rows = simulate(R"([elements]
fast = { type = "mass", at = "fast", mass = 0.3 }
slow = { type = "mass", at = "slow", mass = 0.7 }
drag = { type = "slider", between = ["slow", "ground"], coulomb = 1.1e-9 }
drive = { type = "motion", at = "shaft", velocity = { square = 0.3, frequency = 1.3 } }
turn = { type = "sfm", between = ["shaft", "ground"], stiffness = 25, coulomb = 1.1 }
[nodes]
fast = { velocity = 1e9 }
slow = { velocity = 3.1e-9 }
[simulate]
stop = 1
)",
                                   1e-6);
  CHECK(rows["slow.velocity"].back() == doctest::Approx(3.1e-9 - 1.1e-9 / 0.7).epsilon(1e-6));
  CHECK(rows["fast.velocity"].back() == 1e9);
}

}  // namespace rheonet::test::slow_beside_fast_test
