#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::reversal_beside_pseudoplastic_test {

// A dashpot with a flow index below 1 is solved for its force. When friction in parallel reverses, the velocities of its ends are equal up to
// round-off, which the law turns into a force. This force counted as an imbalance and forced the friction to rest, and then nothing determined
// the node.
TEST_CASE("friction that relaxes reverses beside a pseudoplastic dashpot while both its ends move") {
  const std::string scene = R"([elements]
fixing = { type = "sfm", between = ["block", "ground"], stiffness = 106, coulomb = 0.144, exponent = 1 }
block = { type = "mass", at = "block", mass = 0.149 }
joint = { type = "cfm", between = ["plate", "block"], stiffness = 79.3, coulomb = 1.31, damping = 2.73, exponent = 1 }
gel = { type = "dashpot", between = ["plate", "block"], damping = 29.7, flow_index = 0.5 }
rubber = { type = "vfm", between = ["hand", "plate"], damping = 13.7, stiffness = 45.5 }
oil = { type = "dashpot", between = ["hand", "plate"], damping = 17.9 }
drive = { type = "motion", at = "hand", position = { sine = 0.0622, frequency = 1.53 } }
[simulate]
stop = 3
output = { points = 61 }
record = ["fixing.force", "joint.force", "gel.force", "rubber.force", "oil.force", "block.velocity", "plate.velocity"]
)";
  const RunTable best = simulate(scene, 1e-10);
  for (const double accuracy : {3e-3, 2e-3, 1.5e-3, 1e-3, 5e-4, 1e-6}) {
    CAPTURE(accuracy);
    CHECK(largest_error(simulate(scene, accuracy), best) <= 2 * accuracy);
  }
}

}  // namespace rheonet::test::reversal_beside_pseudoplastic_test
