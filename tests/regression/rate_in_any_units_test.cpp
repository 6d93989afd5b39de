#include <doctest/doctest.h>

#include "core/netlist/scene.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test::rate_in_any_units_test {

// The rate of a network was found from a small change of its state, as large as its largest unknown said, whatever its kind:
// where velocities are large numbers, a deflection went far beyond its law.
TEST_CASE("a network is as fast in units in which velocities are large numbers") {
  using namespace rheonet;
  const Scene scene = test::scene_of(R"([elements]
drive = { type = "force", at = "end", force = { table = [[0, 0.3959], [0.1, -0.56]] } }
e1 = { type = "dashpot", between = ["n1", "end"], damping = 2.361 }
e2 = { type = "sfm", between = ["n1", "n2"], stiffness = 46.06, coulomb = 1.079, exponent = 1 }
e3 = { type = "slider", between = ["n2", "ground"], coulomb = 0.4605, breakaway = 0.6591 }
[simulate]
stop = 0.1
accuracy = 1e-6
output = { points = 11 }
)");
  const test::Scaling scaling{.length = 1e9, .time = 1e-9, .force = 1};
  const test::RunTable run = test::simulate(scene), seen = test::simulate(test::rescaled(scene, scaling));
  for (std::size_t i = 0; i < run.time().size(); ++i) {
    CAPTURE(run.time()[i]);
    const double scale = scaling.length * run.scale("n1.position");
    CHECK(seen["n1.position"][i] / scale == doctest::Approx(run["n1.position"][i] / run.scale("n1.position")).epsilon(1e-5));
  }
}

}  // namespace rheonet::test::rate_in_any_units_test
