#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/check.hpp"

namespace rheonet::test::pseudoplastic_from_rest_test {

// At rest a pseudoplastic dashpot has an infinite slope. Next to a creeping element the mode selection could not distinguish its forces from
// round-off ("it cannot be decided which sliders begin to slip", without any slider).
TEST_CASE("a spring, a pseudoplastic dashpot and a vfm in series, from rest") {
  constexpr double v = -0.5003, frequency = 3.033, k1 = 22.83, B2 = 0.6591, k3 = 9.821, B3 = 1.051;
  // One force f: v = f'/k1 + (f/B2)^2 sgn f + f'/k3 + f/B3. Runge and Kutta's method, between the corners of v.
  const auto slope = [](double t, double f) {
    const double phase = t * frequency - std::floor(t * frequency);
    const double velocity = v * (phase < 0.25 ? 4 * phase : phase < 0.75 ? 2 - 4 * phase : 4 * phase - 4);
    return (velocity - f * std::abs(f) / (B2 * B2) - f / B3) / (1 / k1 + 1 / k3);
  };
  const auto force = [&](double end) {
    double f = 0;
    for (double from = 0; from < end;) {
      const double corner = (std::floor(from * frequency * 4 + 1e-9) + 1) / (4 * frequency), to = std::min(corner, end);
      constexpr int steps = 400;
      const double h = (to - from) / steps;
      for (int k = 0; k < steps; ++k) {
        const double t = from + k * h, a = slope(t, f), b = slope(t + h / 2, f + h / 2 * a);
        const double c = slope(t + h / 2, f + h / 2 * b), d = slope(t + h, f + h * c);
        f += h / 6 * (a + 2 * b + 2 * c + d);
      }
      from = to;
    }
    return f;
  };
  test::check_at_all_accuracies(
      test::netlist({{"v", v}, {"fr", frequency}, {"k1", k1}, {"B2", B2}, {"k3", k3}, {"B3", B3}}, R"([elements]
drive = { type = "motion", at = "end", velocity = { triangle = "v", frequency = "fr" } }
e1 = { type = "spring", between = ["n1", "end"], stiffness = "k1" }
e2 = { type = "dashpot", between = ["n1", "n2"], damping = "B2", flow_index = 0.5 }
e3 = { type = "vfm", between = ["n2", "ground"], stiffness = "k3", damping = "B3" }
)",
                    0.8396, 61),
      {{"e3.force", force}, {"e2.force", force}, {"e1.force", [&](double t) { return -force(t); }}});
}

TEST_CASE("a mass, a spring, a pseudoplastic dashpot and a cfm in series, from rest") {
  test::check_against_closer(test::netlist({}, R"([elements]
drive = { type = "force", at = "end", force = { sine = 0.8063211548163549, frequency = 1.7753835761943573 } }
e1 = { type = "spring", between = ["n1", "end"], stiffness = 59.057470555944946 }
e2 = { type = "dashpot", between = ["n2", "n1"], damping = 0.8870384431885724, flow_index = 0.5 }
e3 = { type = "cfm", between = ["n2", "ground"], stiffness = 7.041, damping = 0.58256, coulomb = 0.53035, exponent = 1.5 }
m = { type = "mass", at = "end", mass = 0.05902883825211436 }
)",
                                           1.1486812281665246, 61),
                             1e-6, {"e3.force", "end.velocity", "n2.velocity", "end.position"});
}

// A dilatant dashpot at rest lets its ends go: without a slope by rounding nothing determined the motion of the nodes.
TEST_CASE("a mass on a cfm, a dashpot and a dilatant one in series, from rest") {
  test::check_against_closer(test::netlist({}, R"([elements]
drive = { type = "force", at = "end", force = { triangle = 0.7174306324673737, frequency = 2.5293298623425273 } }
e1 = { type = "cfm", between = ["n1", "end"], stiffness = 13.4888, damping = 2.97238, coulomb = 0.695823, exponent = 0 }
e2 = { type = "dashpot", between = ["n2", "n1"], damping = 1.2357606313637468 }
e3 = { type = "dashpot", between = ["n2", "ground"], damping = 0.5477731942190207, flow_index = 1.75 }
m = { type = "mass", at = "end", mass = 0.02090124107228199 }
)",
                                           1.143800640772574, 61),
                             1e-6, {"e1.force", "e3.force", "end.velocity", "n2.velocity"});
}

// A gear gives a mass hardly any motion beside its neighbours: its acceleration turns in the first step of 1e-15 s. Turns as often as
// that until the end would have asked for steps that no double can express.
TEST_CASE("a pseudoplastic dashpot at a gear, all from rest") {
  test::check_against_closer(test::netlist({}, R"([elements]
drive = { type = "motion", at = "end", velocity = { sine = -1.94, frequency = 2.91 } }
e1 = { type = "sfm", between = ["ground", "n1"], stiffness = 11.64, coulomb = 0.9518, exponent = 0 }
e2 = { type = "sfm", between = ["n1", "end"], stiffness = 28.82, coulomb = 0.8055, exponent = 0 }
e3 = { type = "spring", between = ["n1", "n4"], stiffness = 23.76 }
e4 = { type = "slider", between = ["n2", "n4"], coulomb = 1.675 }
e5 = { type = "spring", between = ["ground", "n4"], stiffness = 28.59 }
e6 = { type = "sfm", between = ["n2", "ground"], stiffness = 51.85, coulomb = 0.4039, exponent = 1 }
e7 = { type = "dashpot", between = ["n3", "ground"], damping = 1.303, flow_index = 0.5 }
e8 = { type = "vfm", between = ["end", "n4"], stiffness = 7.222, damping = 1.18 }
e9 = { type = "gear", between = ["n4", "n3"], ratio = 1.976, support = "n1" }
m1 = { type = "mass", at = "n1", mass = 0.02305 }
m2 = { type = "mass", at = "n2", mass = 0.07619 }
m3 = { type = "mass", at = "n3", mass = 0.03021 }
m4 = { type = "mass", at = "n4", mass = 0.02059 }
)",
                                           0.8194, 61),
                             1e-6, {"e7.force", "n3.velocity", "n4.velocity", "e8.force"}, 1e-9);
}

}  // namespace rheonet::test::pseudoplastic_from_rest_test
