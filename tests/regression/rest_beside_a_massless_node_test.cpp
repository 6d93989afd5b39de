#include <doctest/doctest.h>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::rest_beside_a_massless_node_test {

// A slider whose ends have come to relative rest was not allowed to continue in its earlier direction, not even if it had broken away at the
// same instant, or if only higher derivatives of the drive determine its direction. The slider alternated between stick and slip.
TEST_CASE("a slider between a massless node and a mass comes to rest, and goes on") {
  SUBCASE("it breaks away in the instant of another change") {
    test::check_against_closer(test::netlist({}, R"([elements]
drive = { type = "force", at = "end", force = { sine = 1.5713, frequency = 2.1583 } }
e1 = { type = "sfm", between = ["end", "ground"], stiffness = 8.825056928380436, coulomb = 1.1159283047203337 }
e2 = { type = "slider", between = ["end", "n1"], coulomb = 0.5193029963128911 }
e3 = { type = "vfm", between = ["n1", "ground"], stiffness = 8.51183391593912, damping = 2.5799417851640887 }
m1 = { type = "mass", at = "n1", mass = 0.012590608319901617 }
)",
                                             1.1042, 61),
                               1e-6, {"e1.force", "e3.force", "n1.velocity", "end.position"});
  }
  SUBCASE("the drive's jerk decides") {
    test::check_against_closer(test::netlist({}, R"([elements]
drive = { type = "motion", at = "end", position = { sine = -0.0834576128435456, frequency = 2.79898740604956 } }
e1 = { type = "slider", between = ["n1", "end"], coulomb = 0.4425682427343184 }
e2 = { type = "spring", between = ["ground", "n1"], stiffness = 17.463922627527005 }
e3 = { type = "vfm", between = ["ground", "end"], stiffness = 13.71597563971065, damping = 0.5717801217410606 }
m1 = { type = "mass", at = "n1", mass = 0.07926017738542353 }
)",
                                             0.9975304208830665, 61),
                               1e-6, {"e2.force", "e3.force", "n1.velocity"});
  }
}

// A slider between a massless node and a mass has its full force at first, which then falls only quadratically in time. The error of the first step let it slip again for a
// moment, and at a loose accuracy many times.
TEST_CASE("a slider that has come to rest at its full force sticks at once, however loose the accuracy") {
  for (const double accuracy : {1e-2, 1e-3, 1e-5, 1e-8}) {
    CAPTURE(accuracy);
    Summary summary;
    test::simulate(test::scene_of(test::netlist({}, R"([elements]
drive = { type = "force", at = "end", force = { sine = 1.5713, frequency = 2.1583 } }
e1 = { type = "sfm", between = ["end", "ground"], stiffness = 8.825, coulomb = 1.1159 }
e2 = { type = "slider", between = ["end", "n1"], coulomb = 0.5193 }
e3 = { type = "vfm", between = ["n1", "ground"], stiffness = 8.5118, damping = 2.5799 }
m1 = { type = "mass", at = "n1", mass = 0.01259 }
)",
                                                1.1042, 61), accuracy), &summary);
    CHECK(summary.events == 17);
    CHECK(summary.restarts == 18);
  }
}

}  // namespace rheonet::test::rest_beside_a_massless_node_test
