#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::power_laws_in_parallel_test {

// A dilatant dashpot beside a pseudoplastic one, at a massless node: solved for its force, which near rest is far below
// every tolerance where its velocity is not, it took 40000 steps over one reversal of the force.
TEST_CASE("a dilatant dashpot beside a pseudoplastic one, under a force that reverses") {
  using namespace rheonet;
  constexpr double B1 = 0.5003788848829955, n1 = 0.5, B2 = 1.1777160523473802, n2 = 1.75;
  const Scene scene = test::scene_of(R"([elements]
drive = { type = "force", at = "end", force = { triangle = 0.7573314252490642, frequency = 1.5838723783716893 } }
e1 = { type = "dashpot", between = ["end", "n1"], damping = 0.5003788848829955, flow_index = 0.5 }
e2 = { type = "dashpot", between = ["n1", "end"], damping = 1.1777160523473802, flow_index = 1.75 }
e3 = { type = "slider", between = ["n1", "ground"], coulomb = 2.1406797526210544, breakaway = 3.118162167257801 }
m = { type = "mass", at = "n1", mass = 0.016628730722754816 }
[simulate]
stop = 1.0884486348974836
accuracy = 1e-6
output = { points = 61 }
)");
  Summary summary;
  const test::RunTable run = test::simulate(scene, &summary);
  CHECK(summary.steps < 3000);
  for (std::size_t i = 0; i < run.time().size(); ++i) {
    CAPTURE(run.time()[i]);
    const double w = run["end.velocity"][i], force = B1 * std::pow(std::abs(w), n1) + B2 * std::pow(std::abs(w), n2);
    CHECK(std::abs(std::copysign(force, w) - run["drive.force"][i]) < 1e-6 * run.scale("drive.force"));
  }
}

}  // namespace rheonet::test::power_laws_in_parallel_test
