// A pseudoplastic dashpot at a gear whose other nodes move: round-off of their velocities comes into its own, which passes zero.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/simulate.hpp"

namespace rheonet::test::turn_of_a_geared_dashpot_test {

// The steps became shorter without an end where the force on the dashpot changed its sign.
TEST_CASE("a thin dashpot at a gear with a free support turns at any accuracy") {
  constexpr double i = -1.9, F = 1.3, f = 2.7, M = 0.064, m1 = 0.017, m2 = 0.021, B = 3.2;
  for (const double n : {0.3, 0.5, 0.8}) {
    CAPTURE(n);
    double last = 0;
    for (const double accuracy : {1e-10, 1e-8, 1e-5, 1e-3}) {
      CAPTURE(accuracy);
      Summary summary;
      const RunTable run = simulate(scene_of(fmt::format(R"([elements]
drive = {{ type = "force", at = "end", force = {{ sine = {}, frequency = {} }} }}
gear  = {{ type = "gear", between = ["n1", "end"], ratio = {}, support = "n2" }}
thin  = {{ type = "dashpot", between = ["n1", "ground"], damping = {}, flow_index = {} }}
m_end = {{ type = "mass", at = "end", mass = {} }}
m1    = {{ type = "mass", at = "n1", mass = {} }}
m2    = {{ type = "mass", at = "n2", mass = {} }}
[simulate]
stop = 1
output = {{ points = 41 }}
)", F, f, i, B, n, M, m1, m2), accuracy), &summary);
      CHECK(summary.steps < 20'000);
      // The gear passes on the forces g at n1, -i g at the end, and (i - 1) g at its support.
      const double w = 2 * std::numbers::pi * f, largest = 2 * F / w;
      double worst = 0;
      for (std::size_t row = 0; row < run.time().size(); ++row) {
        const double impulse = F / w * (1 - std::cos(w * run.time()[row]));
        worst = std::max(worst, std::abs(M * run["end.velocity"][row] + i / (i - 1) * m2 * run["n2.velocity"][row] - impulse));
      }
      CHECK(worst <= 10 * accuracy * largest);
      // The work that the dashpot dissipates tells of its own velocity.
      if (accuracy == 1e-10) last = summary.dissipated;
      CHECK(summary.dissipated == doctest::Approx(last).epsilon(10 * accuracy));
    }
    CHECK(last > 0);
  }
}

}  // namespace rheonet::test::turn_of_a_geared_dashpot_test
