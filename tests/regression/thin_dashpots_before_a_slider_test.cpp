// Two pseudoplastic dashpots in series with a slider, and a motion that begins with a jump: Newton's method is slow at them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::thin_dashpots_before_a_slider_test {

TEST_CASE("a slider behind two thin dashpots slips with its force from the jump on") {
  for (const double n : {0.8, 0.4, 0.25}) {
    for (const double m : {0.32, 0.1, 0.05}) {
      for (const double V : {0.9, 8.2, 300.0}) {
        for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
          CAPTURE(n);
          CAPTURE(m);
          CAPTURE(V);
          CAPTURE(accuracy);
          // The dashpots pass on the force of the slider at constant velocities as long as the mass is slower than the rest of V.
          const RunTable run = simulate(fmt::format(R"([elements]
pull  = {{ type = "motion", at = "n0", velocity = {{ step = {}, time = 0.3 }} }}
first = {{ type = "dashpot", between = ["n0", "n1"], damping = 0.5, flow_index = {} }}
next  = {{ type = "dashpot", between = ["n1", "n2"], damping = 0.6, flow_index = {} }}
slide = {{ type = "slider", between = ["n2", "n3"], coulomb = 0.3 }}
m     = {{ type = "mass", at = "n3", mass = 0.5 }}
[simulate]
stop = 0.6
output = {{ every = 0.04 }}
)", V, n, m), accuracy);
          const double creep = std::pow(0.3 / 0.5, 1 / n) + std::pow(0.3 / 0.6, 1 / m);
          REQUIRE(V - creep > 0.3 * 0.6);
          for (std::size_t row = 0; row < run.time().size(); ++row) {
            CHECK(std::abs(run["n3.velocity"][row] - 0.6 * std::max(0.0, run.time()[row] - 0.3)) <= accuracy * 0.18);
          }
        }
      }
    }
  }
}

}  // namespace rheonet::test::thin_dashpots_before_a_slider_test
