#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/simulate.hpp"

namespace rheonet::test::force_near_coulomb_test {

// A force within round-off of the Coulomb force determines the deflection to only a few digits. Steps became so short that a run would have
// taken hours. The exponent 1 gives f = Fc (1 - exp(-sigma x/Fc)).
TEST_CASE("a force that comes close to all that friction can take is followed as far as it is known") {
  constexpr double sigma = 137, Fc = 0.53, frequency = 1.3, epsilon = 2.2e-16;
  for (const double missing : {1e-2, 2e-7, 2e-8, 2e-10}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-8, 1e-10}) {
      CAPTURE(missing);
      CAPTURE(accuracy);
      const double amplitude = Fc * (1 - missing);
      const RunTable rows = simulate(fmt::format(R"([elements]
push = {{ type = "force", at = "a", force = {{ sine = {}, frequency = {} }} }}
friction = {{ type = "sfm", between = ["a", "ground"], stiffness = {}, coulomb = {}, exponent = 1 }}
[simulate]
stop = 1.1
output = {{ points = 301 }}
record = ["a.position", "friction.force"]
)",
                                                   amplitude, frequency, sigma, Fc),
                                       accuracy);
      const double farthest = -Fc / sigma * std::log(missing);
      // A change of the force by its rounding is one of the deflection by that over the slope sigma (1 - f/Fc).
      const double known = 64 * epsilon * Fc / (sigma * missing);
      double worst = 0;
      for (std::size_t k = 0; k < rows.time().size(); ++k) {
        const double t = rows.time()[k], force = amplitude * std::sin(2 * std::numbers::pi * frequency * t);
        CHECK(std::abs(rows["friction.force"][k] - force) <= accuracy * Fc);
        if (t < 0.25 / frequency) worst = std::max(worst, std::abs(rows["a.position"][k] + Fc / sigma * std::log1p(-force / Fc)));
      }
      CHECK(worst <= accuracy * farthest + known);
    }
  }
}

// Friction that has slid far has a deflection of many presliding lengths. At a reversal the round-off of this deflection acts on the elements
// in series.
TEST_CASE("friction that has slid far turns in series with others without being followed into its rounding") {
  const auto scene = [](double accuracy) {
    return simulate(R"([elements]
drive = { type = "motion", at = "a", velocity = { sine = 1, frequency = 0.7 } }
far = { type = "sfm", between = ["a", "n"], coulomb = 1, stiffness = 1000, exponent = 1 }
block = { type = "slider", between = ["n", "ground"], coulomb = 0.8 }
lag = { type = "vfm", between = ["n", "ground"], damping = 3, stiffness = 500 }
[simulate]
stop = 2.1
output = { points = 211 }
record = ["far.force", "lag.force"]
)",
                    accuracy);
  };
  const RunTable rows = scene(1e-10), coarse = scene(1e-6);
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    CHECK(std::abs(rows["far.force"][k] - coarse["far.force"][k]) < 1e-6);
    CHECK(std::abs(rows["lag.force"][k] - coarse["lag.force"][k]) < 1e-6);
  }
  CHECK(rows.scale("far.force") == doctest::Approx(1).epsilon(1e-9));
}

}  // namespace rheonet::test::force_near_coulomb_test
