#include <doctest/doctest.h>

#include <cmath>

#include "core/network/component.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::power_laws_in_series_test {

// Near rest the force of a power law was linearised, but not its inverse, which is solved at a massless node. Two dashpots in series, set in
// motion from rest, ended the run ("changes faster than double precision can follow").
TEST_CASE("power-law dashpots in series, set in motion from rest") {
  constexpr double accuracy = 1e-6;
  for (const double n : {0.9, 0.5, 0.3}) {
    CAPTURE(n);
    const auto run = [n](bool two) {
      constexpr double B1 = 1.5, B2 = 4.1;
      test::SceneBuilder b;
      b.motion("drive", "a", "velocity", Signal(Signal::Step{0.83, 0.11, 0}));
      b.between("c", "dashpot", "a", "b", {{"damping", 2.6}});
      b.at("m", "mass", "b", {{"mass", 0.13}});
      if (two) {
        b.between("c1", "dashpot", "b", "c", {{"damping", B1}, {"flow_index", n}});
        b.between("c2", "dashpot", "c", "ground", {{"damping", B2}, {"flow_index", n}});
      } else {
        // (f/B)^(1/n) = (f/B1)^(1/n) + (f/B2)^(1/n)
        const double B = std::pow(std::pow(B1, -1 / n) + std::pow(B2, -1 / n), -n);
        b.between("c2", "dashpot", "b", "ground", {{"damping", B}, {"flow_index", n}});
      }
      return test::simulate(b.finish(1.3, 40, accuracy));
    };
    const test::RunTable two = run(true), one = run(false);
    for (const char* column : {"b.velocity", "c2.force"}) {
      CAPTURE(column);
      for (std::size_t k = 0; k < one.time().size(); ++k) {
        CAPTURE(one.time()[k]);
        CHECK(std::abs(two[column][k] - one[column][k]) <= 10 * accuracy * one.scale(column));
      }
    }
    CHECK(one.scale("c2.force") > 0.5);
  }
}

TEST_CASE("velocity and force of a power law are inverse to each other, softened or not") {
  for (const double n : {0.3, 0.7, 1.0, 1.8}) {
    const std::vector<double> values{2.3, n, not_given};
    const auto batch = find_component("dashpot")->rate({std::span<const double>(values)});
    for (const double soft : {0.0, 1e-3}) {
      batch->regularise(0, soft);
      for (const double w : {1e-5, 0.99e-3, 1.01e-3, 0.4, 7.0}) {
        CAPTURE(n);
        CAPTURE(soft);
        CAPTURE(w);
        for (const double sign : {1.0, -1.0}) {
          CHECK(batch->velocity_at(0, batch->force_at(0, sign * w)) == doctest::Approx(sign * w).epsilon(1e-13));
        }
        if (w > 100 * soft) CHECK(batch->force_at(0, w) == doctest::Approx(2.3 * std::pow(w, n)).epsilon(1e-14));
      }
    }
  }
}

}  // namespace rheonet::test::power_laws_in_series_test
