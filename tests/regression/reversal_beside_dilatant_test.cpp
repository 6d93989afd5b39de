#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::reversal_beside_dilatant_test {

// All starts without force, and nothing happens until the friction reverses: by then the forces have a rounding, of which the
// dilatant dashpot at rest makes a velocity that is far above the tolerance. As long as it was known at starts alone steps
// went down to nothing there.
TEST_CASE("friction reverses beside a dilatant dashpot, under forces that have grown since the start") {
  const std::string scene = R"([elements]
post = { type = "spring", between = ["base", "ground"], stiffness = 6.15 }
dry = { type = "sfm", between = ["slide", "base"], stiffness = 15.8, coulomb = 0.836, exponent = 0 }
water = { type = "dashpot", between = ["slide", "base"], damping = 0.445, flow_index = 2 }
soft = { type = "cfm", between = ["hand", "slide"], stiffness = 15, coulomb = 0.293, damping = 3.64, exponent = 2 }
stiff = { type = "cfm", between = ["hand", "slide"], stiffness = 279, coulomb = 0.358, damping = 0.465, exponent = 3 }
seal = { type = "sfm", between = ["base", "slide"], stiffness = 34.7, coulomb = 0.226, exponent = 1 }
drive = { type = "motion", at = "hand", position = { sine = 0.121, frequency = 0.548 } }
[simulate]
stop = 1
output = { points = 41 }
record = ["post.force", "dry.force", "water.force", "soft.force", "stiff.force", "seal.force", "base.velocity", "slide.velocity"]
)";
  const RunTable best = simulate(scene, 1e-10);
  for (const double accuracy : {1e-6, 3e-9, 2.5e-9, 2e-9, 1.6e-9, 1.3e-9, 1e-9, 7e-10, 5e-10, 4e-10}) {
    CAPTURE(accuracy);
    CHECK(largest_error(simulate(scene, accuracy), best) <= 2 * accuracy);
  }
}

}  // namespace rheonet::test::reversal_beside_dilatant_test
