#include <doctest/doctest.h>

#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::dilatant_at_rest_test {

// A dilatant dashpot hardly resists where it is slow: what steps leave of forces there was taken for a velocity the other way.
// Friction at the end of the chain turned for nothing, at one accuracy after the other without end.
TEST_CASE("friction at the end of a chain that relaxes to rest behind a dilatant dashpot does not turn over and over") {
  for (const double accuracy : {1e-6, 2.512e-7, 1e-7, 1e-8, 1e-9, 3.981e-10, 1e-10}) {
    CAPTURE(accuracy);
    rheonet::Summary summary;
    rheonet::test::simulate(rheonet::test::scene_of(fmt::format(R"([elements]
e1 = {{ type = "slider", between = ["n0", "ground"], coulomb = 0.774 }}
e2 = {{ type = "vfm", between = ["n0", "ground"], damping = 3.62, stiffness = 27.2 }}
e3 = {{ type = "slider", between = ["n1", "n0"], coulomb = 0.439 }}
e4 = {{ type = "dashpot", between = ["n2", "n1"], damping = 0.87, flow_index = 2 }}
e5 = {{ type = "vfm", between = ["n2", "n1"], damping = 6.44, stiffness = 115 }}
e6 = {{ type = "vfm", between = ["n3", "n2"], damping = 28.4, stiffness = 345 }}
e7 = {{ type = "cfm", between = ["n3", "ground"], stiffness = 212, coulomb = 0.293, damping = 0.704, exponent = 0 }}
m8 = {{ type = "mass", at = "n0", mass = 1.33 }}
m9 = {{ type = "mass", at = "n1", mass = 0.565 }}
f = {{ type = "force", at = "n1", force = {{ ramp = -0.916, offset = 0.916 }} }}
[simulate]
stop = 3
accuracy = {}
output = {{ points = 61 }}
)", accuracy)), &summary);
    CHECK(summary.events == 4);
  }
}

}  // namespace rheonet::test::dilatant_at_rest_test
