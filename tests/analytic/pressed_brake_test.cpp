// A brake whose normal force falls through 0 while it holds.
#include <doctest/doctest.h>

#include <string>

#include "tests/analytic/slider_checks.hpp"

using namespace rheonet;
using namespace rheonet::test;

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
