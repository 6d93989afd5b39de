// A brake whose normal force falls through 0 while it holds.
#include <doctest/doctest.h>

#include <string>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::pressed_brake_test {

// The force of a spring presses the brake, and falls through 0 while the brake holds. It lets go there, once, and slips.
TEST_CASE("brake: pressed by the force of a spring that swings, between a mass and a vibrator") {
  const std::string toml = R"(
[elements]
base  = { type = "motion", at = "base", velocity = { sine = "0.4 m/s", frequency = "1.3 Hz" } }
mp    = { type = "mass", at = "p", mass = 0.6 }
c     = { type = "dashpot", between = ["p", "base"], damping = "1.5 N*s/m" }
k     = { type = "spring", between = ["q", "base"], stiffness = "90 N/m" }
m     = { type = "mass", at = "q", mass = "1.1 kg" }
press = { type = "gain", in = "k.force", gain = 0.8 }
brake = { type = "slider", between = ["p", "r"], coulomb = 0.5, normal = { block = "press" } }
ks    = { type = "spring", between = ["r", "t"], stiffness = "40 N/m" }
mr    = { type = "mass", at = "r", mass = "0.2 kg" }
mt    = { type = "mass", at = "t", mass = "0.3 kg" }
[simulate]
stop = "5 s"
output = { points = 201 }
record = ["p.position", "r.position", "t.position", "q.position"]
)";
  check_against_closer(toml, 1e-6, {"p.position", "r.position", "t.position", "q.position"});
}

// It comes to rest at a node without mass just as its normal force begins to rise from 0: the round-off of its force is larger than its bound.
TEST_CASE("brake: at rest while its bound is smaller than the round-off of the forces beside it") {
  const std::string toml = R"(
[elements]
mn0 = { type = "mass", at = "n0", mass = 0.5 }
mot = { type = "motion", at = "drv", velocity = { triangle = 1.35, frequency = 2.22, offset = 0.03, phase = 3.0 } }
spring1 = { type = "spring", between = ["n0", "drv"], stiffness = 43.8716 }
spring2 = { type = "spring", between = ["n1", "ground"], stiffness = 90.0 }
slider3 = { type = "slider", between = ["n1", "ground"], coulomb = 0.4, normal = { sine = 5.3, frequency = 1.1789, offset = 0.7046, phase = 4.5029 } }
sfm4 = { type = "sfm", between = ["n1", "drv"], stiffness = 106.0, coulomb = 1.58 }
stop5 = { type = "stop", between = ["n0", "n1"], upper = 0.2, stiffness = 432.0 }
[simulate]
stop = 2.64
output = { points = 301 }
record = ["n0.position", "n1.position"]
)";
  check_against_closer(toml, 1e-8, {"n0.position", "n1.position"});
}

}  // namespace rheonet::test::pressed_brake_test
