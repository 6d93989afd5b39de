#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/check.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::power_law_comes_to_rest_test {

// The velocity of a dilatant dashpot near rest is a root of its force. The round-off of the force kept it moving back and forth.
TEST_CASE("a spring relaxes through a dilatant dashpot, and comes to rest in a finite time") {
  constexpr double k = 1.3, B = 0.9, dx = 0.8;
  for (const double n : {1.5, 1.75, 2.0, 3.0, 5.0}) {
    for (const double accuracy : accuracies) {
      CAPTURE(n);
      CAPTURE(accuracy);
      SceneBuilder b;
      b.motion("drive", "p", "position", Signal(Signal::Step{dx, 0, 0}));
      b.between("k", "spring", "p", "q", {{"stiffness", k}});
      b.between("c", "dashpot", "q", "ground", {{"damping", B}, {"flow_index", n}});
      const RunTable run = simulate(b.finish(5, 100, accuracy));
      // df/dt = -k (f/B)^(1/n): with q = 1 - 1/n, f^q falls linearly to 0.
      const double q = 1 - 1 / n;
      const auto force = [&](double t) {
        return std::pow(std::max(0.0, std::pow(k * dx, q) - q * k * std::pow(B, -1 / n) * t), 1 / q);
      };
      CHECK(force(5) == 0);
      check_against(run, {"k.force", force}, accuracy);
    }
  }
}

// With a flow index n < 1 the velocity is a power of time near a reversal, but events were located on a polynomial. So the reversal of the cfm
// in parallel came too early, and its force jumped.
TEST_CASE("a cfm beside a pseudoplastic dashpot turns where the velocity is 0, and its force goes on") {
  const char* const scene = R"([elements]
f = { type = "force", at = "a", force = { sine = "1.5 N", frequency = "1 Hz" } }
e = { type = "cfm", between = ["a", "ground"], stiffness = 20, coulomb = 1, damping = 0.5 }
c = { type = "dashpot", between = ["a", "ground"], damping = 2, flow_index = 0.5 }
[simulate]
stop = 2
output = { points = 41 }
)";
  // By Runge-Kutta with steps of 1e-6 s and the sliding state of w = 0; half a period later the same with the other sign.
  constexpr double at_half_period = 0.010530;
  for (const double accuracy : {1e-5, 1e-6, 1e-7, 1e-9}) {
    CAPTURE(accuracy);
    const RunTable run = simulate(scene, accuracy);
    CHECK(std::abs(run.time()[10] - 0.5) < 1e-12);
    CHECK(std::abs(run["e.force"][10] - at_half_period) < 1e-6 + 10 * accuracy * run.scale("e.force"));
    CHECK(std::abs(run["e.force"][20] + at_half_period) < 1e-6 + 10 * accuracy * run.scale("e.force"));
    CHECK(std::abs(run["e.force"][30] - at_half_period) < 1e-6 + 10 * accuracy * run.scale("e.force"));
  }
}

}  // namespace rheonet::test::power_law_comes_to_rest_test
