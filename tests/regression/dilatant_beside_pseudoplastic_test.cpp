#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/simulate.hpp"

namespace rheonet::test::dilatant_beside_pseudoplastic_test {

// The force of a dilatant dashpot between masses follows from their velocities. It was that of a law that is linear near rest, which was
// wider than the accuracy of a force as small as this one.
TEST_CASE("a dilatant dashpot between masses has the force of its law at any velocity") {
  const RunTable rows = simulate(R"([elements]
push = { type = "force", at = "x", force = { cosine = "1.2 N", frequency = "2.4 Hz" } }
m1 = { type = "mass", at = "x", mass = "25 g" }
k = { type = "spring", between = ["x", "ground"], stiffness = "20 N/m" }
m2 = { type = "mass", at = "y", mass = "10 g" }
thin = { type = "dashpot", between = ["x", "y"], damping = 2.3, flow_index = 0.5 }
thick = { type = "dashpot", between = ["x", "y"], damping = 1.1, flow_index = 2 }
k2 = { type = "spring", between = ["y", "ground"], stiffness = "7 N/m" }
[simulate]
stop = 1
accuracy = 1e-6
output = { points = 61 }
)");
  const std::vector<double>&force = rows["thick.force"], &velocity = rows["thick.velocity"];
  for (std::size_t i = 0; i < force.size(); ++i) CHECK(std::abs(force[i] - 1.1 * std::abs(velocity[i]) * velocity[i]) <= 1e-14 * rows.scale("thick.force"));
}

}  // namespace rheonet::test::dilatant_beside_pseudoplastic_test
