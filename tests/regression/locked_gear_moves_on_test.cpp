// A gear with losses locks its nodes to each other. Another gear sets them in motion as one body.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::locked_gear_moves_on_test {

// Where they began to move, the error of that acceleration was taken for a load that nothing holds: refused.
TEST_CASE("a gear locked by its losses moves as one body, behind another gear that turns with losses") {
  constexpr double A = 1.17, f = 2.87, i = 1.48, efficiency = 0.7, bearing = 0.21, m_end = 0.044, m2 = 0.018, m3 = 0.047, m4 = 0.015;
  // The load grows by k a second and overcomes the friction of the first gear at t0.
  constexpr double k = 4 * A * f, t0 = bearing / efficiency / k, mass = m_end + m3 + m4 + m2 / (i * i * efficiency);
  for (const double side : {-1, 1}) {
    CAPTURE(side);
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(accuracy);
      const RunTable run = simulate(fmt::format(R"([elements]
drive  = {{ type = "force", at = "end", force = {{ triangle = {}, frequency = {} }} }}
hold   = {{ type = "slider", between = ["n3", "end"], coulomb = 1.07 }}
first  = {{ type = "gear", between = ["end", "n2"], ratio = {}, efficiency = [{}, 0.75], bearing = {} }}
second = {{ type = "gear", between = ["n4", "end"], ratio = -1.91, support = "n3", efficiency = [0.86, 0.72], bearing = 0.18 }}
m_end  = {{ type = "mass", at = "end", mass = {} }}
m2     = {{ type = "mass", at = "n2", mass = {} }}
m3     = {{ type = "mass", at = "n3", mass = {} }}
m4     = {{ type = "mass", at = "n4", mass = {} }}
[simulate]
stop = 0.08
output = {{ points = 33 }}
)", side * A, f, i, efficiency, bearing, m_end, m2, m3, m4), accuracy);
      const auto velocity = [&](double t) { return side * k / 2 * std::pow(std::max(0.0, t - t0), 2) / mass; };
      double worst = 0;
      for (std::size_t row = 0; row < run.time().size(); ++row) {
        const double v = velocity(run.time()[row]);
        for (const char* node : {"end", "n3", "n4"}) worst = std::max(worst, std::abs(run[fmt::format("{}.velocity", node)][row] - v));
        worst = std::max(worst, std::abs(run["n2.velocity"][row] - v / i));
      }
      CHECK(worst <= accuracy * std::abs(velocity(0.08)));
    }
  }
}

}  // namespace rheonet::test::locked_gear_moves_on_test
