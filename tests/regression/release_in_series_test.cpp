#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::release_in_series_test {

// A cfm with exponent 0 had slope 0 at the point where it left its bound. So its ends seemed to move freely there, the margin of its events was
// as large as that velocity, and the next reversal was missed.
TEST_CASE("a cfm between a spring and an sfm leaves its bound, turns, and yields the other way") {
  const char* const scene = R"([elements]
drive = { type = "motion", at = "end", velocity = { square = 0.672, frequency = 1.6125 } }
e1 = { type = "spring", between = ["n1", "end"], stiffness = 7.86 }
e2 = { type = "cfm", between = ["n2", "n1"], stiffness = 31.8, damping = 0.831, coulomb = 0.4007, exponent = 0 }
e3 = { type = "sfm", between = ["ground", "n2"], stiffness = 23.8, coulomb = 2.098, exponent = 0.5 }
[simulate]
stop = 0.957
accuracy = 1e-6
output = { points = 401 }
)";
  const test::RunTable run = test::simulate(scene);
  CHECK(run.scale("e2.force") <= 0.4007 * (1 + 1e-15));
  // At the end of each half period it has yielded: all the motion is its own, to the other side each time.
  const double half = 0.5 / 1.6125;
  for (std::size_t row = 0; row < run.time().size(); ++row) {
    const double t = run.time()[row], within = std::fmod(t, half);
    if (within < 0.99 * half || t > 3 * half) continue;
    const double side = static_cast<int>(t / half) % 2 ? 1 : -1;
    CHECK(run["e2.force"][row] == doctest::Approx(side * 0.4007).epsilon(1e-12));
    CHECK(run["e2.velocity"][row] == doctest::Approx(side * 0.672).epsilon(1e-9));
  }
}

}  // namespace rheonet::test::release_in_series_test
