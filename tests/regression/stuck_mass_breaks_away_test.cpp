// A slider drags a mass along with a drive, against another slider; the acceleration of the drive breaks it away. The regularisation that
// decides between equal sliders outweighed the round-off by which the bound is exceeded, and the slider never broke away.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::stuck_mass_breaks_away_test {

TEST_CASE("regression: a mass that a drive takes along breaks away from it") {
  const double m = 1.03, Fc = 1.91, F0 = 0.41, speed = 0.53, omega = 2 * 3.14159265358979323846 * 0.83;
  const std::string scene = fmt::format(R"(
[elements]
drive   = {{ type = "motion", at = "belt", velocity = {{ sine = {}, frequency = 0.83 }} }}
clutch  = {{ type = "slider", between = ["belt", "block"], coulomb = {} }}
mass    = {{ type = "mass", at = "block", mass = {} }}
brake   = {{ type = "slider", between = ["block", "ground"], coulomb = {} }}
[simulate]
stop = 0.9
output = {{ points = 2, events = true }}
)",
                                        speed, Fc, m, F0);
  // At the start m a = m speed omega exceeds the force of the clutch minus that of the brake, so that it slips at once. It sticks when the belt
  // has slowed down to the velocity of the block, and slips again when m (-a) = Fc + F0.
  const double push = (Fc - F0) / m;
  REQUIRE(push < speed * omega);
  double low = std::acos(push / (speed * omega)) / omega, high = 3.14159265358979323846 / omega;
  for (int k = 0; k < 200; ++k) {
    const double t = (low + high) / 2;
    (push * t < speed * std::sin(omega * t) ? low : high) = t;
  }
  const double stick = low, slip = (3.14159265358979323846 - std::acos((Fc + F0) / (m * speed * omega))) / omega;
  REQUIRE(stick < slip);
  const RunTable rows = simulate(scene, 1e-9);
  std::vector<double> found;
  for (std::size_t row = 1; row < rows.time().size(); ++row) {
    if (rows.time()[row] == rows.time()[row - 1]) found.push_back(rows.time()[row]);
  }
  REQUIRE_GE(found.size(), 2);
  CHECK_LE(std::abs(found[0] - stick), 1e-8);
  CHECK_LE(std::abs(found[1] - slip), 1e-8);
}

}  // namespace rheonet::test::stuck_mass_breaks_away_test
