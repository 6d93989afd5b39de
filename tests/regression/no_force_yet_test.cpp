#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test::no_force_yet_test {

// Where no force was at work yet a power law was judged by what it does at one newton: in some units a rounding, in others
// beyond all bounds.
TEST_CASE("a run that begins without any force is the same in other units") {
  using namespace rheonet;
  const auto check = [](const std::string& toml, const std::string& path, const test::Scaling& scaling) {
    CAPTURE(path);
    const Scene scene = test::scene_of(toml + "[simulate]\nstop = 1.04\naccuracy = 1e-6\noutput = { points = 61 }\n");
    const test::RunTable run = test::simulate(scene), seen = test::simulate(test::rescaled(scene, scaling));
    for (std::size_t i = 0; i < run.time().size(); ++i) {
      CAPTURE(run.time()[i]);
      const double back = seen[path][i] / scaling.length;
      CHECK(std::abs(back - run[path][i]) < 1e-5 * run.scale(path));
    }
  };
  // n2 lags behind what feels no force at first.
  check(R"([elements]
drive = { type = "motion", at = "end", position = { triangle = -0.1044, frequency = 1.366 } }
e1 = { type = "vfm", between = ["n1", "end"], stiffness = 35.59, damping = 0.6564 }
e2 = { type = "dashpot", between = ["n2", "n1"], damping = 0.8092 }
e3 = { type = "dashpot", between = ["n2", "ground"], damping = 3.556, flow_index = 0.5 }
)",
        "n2.position", {.length = 1, .time = 1e9, .force = 1e-9});
  check(R"([elements]
drive = { type = "force", at = "end", force = { sine = -0.9175, frequency = 1.852 } }
e1 = { type = "dashpot", between = ["n1", "end"], damping = 2.635, flow_index = 0.5 }
e2 = { type = "sfm", between = ["n1", "ground"], stiffness = 55.34, coulomb = 0.6441, exponent = 1 }
e3 = { type = "cfm", between = ["ground", "end"], stiffness = 12.24, damping = 2.121, coulomb = 0.5175, exponent = 0 }
)",
        "n1.position", {.length = 1e-9, .time = 1, .force = 1e9});
}

}  // namespace rheonet::test::no_force_yet_test
