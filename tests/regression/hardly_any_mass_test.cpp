#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/check.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::hardly_any_mass_test {

// The force of a dashpot that drags a small mass was computed from the difference of two nearly equal velocities: from their round-off and
// iteration errors.
TEST_CASE("a dashpot that takes along hardly any mass knows its force") {
  constexpr double F = 3.1, m = 0.7, c = 0.9, length = 5;
  for (const double light : {4e-5, 4e-7, 1e-12}) {
    for (const double accuracy : test::accuracies) {
      CAPTURE(light);
      CAPTURE(accuracy);
      test::SceneBuilder b;
      b.force("pull", "m", Signal(Signal::Constant{F}));
      b.at("m", "mass", "m", {{"mass", m}});
      b.between("c", "dashpot", "m", "light", {{"damping", c}});
      b.at("light", "mass", "light", {{"mass", light}});
      const test::RunTable run = test::simulate(b.finish(length, 50, accuracy));
      const double a = F / (m + light), rate = c * (1 / m + 1 / light);
      const auto force = [&](double t) { return light * a * -std::expm1(-rate * t); };
      test::check_against(run, {"c.force", force}, accuracy);
      test::check_against(run, {"c.velocity", [&](double t) { return force(t) / c; }}, accuracy);
      test::check_against(run, {"light.force", force}, accuracy);
    }
  }
}

// If only driven nodes move at the start, no rate of change of a velocity was found. A velocity of 4e7 m/s was foreseen, and the tolerances
// of the first steps were relative to it.
TEST_CASE("a mass between a spring and a dashpot that is hardly any begins as none would") {
  constexpr double V = 0.7, c = 1.3, k = 2.9;
  for (const double mass : {1e-15, 1e-9, 1e-30}) {
    for (const double accuracy : {1e-3, 1e-6, 1e-7, 1e-8, 1e-9}) {
      CAPTURE(mass);
      CAPTURE(accuracy);
      test::SceneBuilder b;
      b.motion("drive", "end", "velocity", Signal(Signal::Constant{V}));
      b.between("k", "spring", "end", "mid", {{"stiffness", k}});
      b.at("m", "mass", "mid", {{"mass", mass}});
      b.between("c", "dashpot", "mid", "ground", {{"damping", c}});
      const test::RunTable run = test::simulate(b.finish(2, 200, accuracy));
      // The mass is behind by m/c times the change of its velocity.
      const double allowed = accuracy + mass * k / (c * c);
      test::check_against(run, {"k.displacement", [&](double t) { return -V * c / k * std::expm1(-k * t / c); }}, allowed / 5);
    }
  }
}

}  // namespace rheonet::test::hardly_any_mass_test
