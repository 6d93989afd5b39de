#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::nothing_unknown_test {

// Where every motion is given there is no error that a step could make, and yet each stretch began with short ones.
TEST_CASE("with nothing unknown a run takes one step from each reversal to the next") {
  constexpr double sigma = 3, Fc = 1.1, A = 0.25;
  Summary summary;
  const test::RunTable rows = test::simulate(test::scene_of(R"([elements]
drive = { type = "motion", at = "shaft", position = { triangle = 0.25, frequency = 1 } }
i1 = { type = "sfm", between = ["shaft", "ground"], stiffness = 3, coulomb = 1.1 }
[simulate]
stop = 200.25
output = { every = 0.0625 }
)"),
                                              &summary);
  CHECK(summary.steps == 401);
  // Rows within the steps are those of the law: down from the last turn but one.
  const double top = Fc * std::tanh(sigma * A / Fc), down = sigma * 0.25 / Fc;  // 1 m/s for 0.25 s
  CHECK(rows["i1.force"].back() == doctest::Approx(top).epsilon(1e-12));
  const std::size_t row = rows.time().size() - 13;  // 0.75 s before the end: 0.25 s after a turn at the top
  CHECK(rows["i1.force"][row] == doctest::Approx(-Fc + (Fc + top) * std::exp(-down)).epsilon(1e-12));
}

}  // namespace rheonet::test::nothing_unknown_test
