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

// Refused in the first microsecond: a gear of two nodes hid that the dashpot is at the support of another one.
TEST_CASE("a thin dashpot behind a gear from the support of another turns at any accuracy") {
  constexpr double F = 0.7, f = 2.5, i = 0.51, m_end = 0.01, m2 = 0.06, m3 = 0.012, m4 = 0.011, k = 34.5, B = 1.12;
  for (const double accuracy : {1e-10, 1e-8, 1e-6, 1e-3}) {
    CAPTURE(accuracy);
    Summary summary;
    const RunTable run = simulate(scene_of(fmt::format(R"([elements]
drive = {{ type = "force", at = "end", force = {{ square = {}, frequency = {} }} }}
e2    = {{ type = "vfm", between = ["n3", "end"], stiffness = {}, damping = {} }}
first = {{ type = "gear", between = ["n1", "n4"], ratio = -1.03 }}
thin  = {{ type = "dashpot", between = ["ground", "n4"], damping = 4.31, flow_index = 0.5 }}
gear  = {{ type = "gear", between = ["n3", "n2"], ratio = {}, support = "n1" }}
m_end = {{ type = "mass", at = "end", mass = {} }}
m2    = {{ type = "mass", at = "n2", mass = {} }}
m3    = {{ type = "mass", at = "n3", mass = {} }}
m4    = {{ type = "mass", at = "n4", mass = {} }}
[simulate]
stop = 0.8
output = {{ points = 41 }}
)", -F, f, k, B, i, m_end, m2, m3, m4), accuracy), &summary);
    CHECK(summary.steps < 20'000);
    // The gear passes on the forces g at n3 and -i g at n2. The force on the end changes its sign after each 10 rows.
    double impulse = 0, worst = 0;
    for (std::size_t row = 0; row < run.time().size(); ++row) {
      if (row > 0) impulse += F * (row % 20 > 0 && row % 20 <= 10 ? -1 : 1) * 0.02;
      worst = std::max(worst, std::abs(m_end * run["end.velocity"][row] + m3 * run["n3.velocity"][row] + m2 / i * run["n2.velocity"][row] - impulse));
    }
    CHECK(worst <= 10 * accuracy * F / (2 * f));
  }
}

}  // namespace rheonet::test::turn_of_a_geared_dashpot_test
