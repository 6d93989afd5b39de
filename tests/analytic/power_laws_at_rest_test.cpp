// Power laws in series that are set in motion from rest by a velocity that begins with 0: the velocity between them begins
// like a power of time, and no slope of either law is finite there.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/check.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::power_laws_at_rest_test {

namespace {

struct PowerLaw { double B, n; };

/// The force at which the velocities of all add up to w: by bisection.
double force_of(const std::vector<PowerLaw>& laws, double w) {
  double low = 0, high = 1e3;
  for (int k = 0; k < 200; ++k) {
    const double f = (low + high) / 2;
    double sum = 0;
    for (const PowerLaw& law : laws) sum += std::pow(f / law.B, 1 / law.n);
    (sum < std::abs(w) ? low : high) = f;
  }
  return std::copysign(low, w);
}

}  // namespace

TEST_CASE("power laws in series behind a velocity that begins with 0") {
  constexpr double v = 0.71, frequency = 1.3;
  const std::vector<PowerLaw> chains[] = {
      {{2.1, 1.4}, {1.3, 1.9}}, {{2.1, 1.4}, {1.3, 0.7}},  {{2.1, 2}, {0.4, 2}}, {{2.1, 0.4}, {1.3, 0.6}},
      {{2.1, 1.4}, {1.3, 1.9}, {0.6, 1.2}}, {{2.1, 1.75}, {1.3, 1}, {0.6, 0.5}},
  };
  for (const std::vector<PowerLaw>& chain : chains) {
    for (const double accuracy : accuracies) {
      CAPTURE(chain.size());
      CAPTURE(chain[1].n);
      CAPTURE(accuracy);
      SceneBuilder b;
      b.motion("drive", "n0", "velocity", Signal(Signal::Sine{v, frequency, 0, 0, 0}));
      for (std::size_t k = 0; k < chain.size(); ++k) {
        const std::string end = k + 1 == chain.size() ? "ground" : "n" + std::to_string(k + 1);
        b.between("c" + std::to_string(k), "dashpot", "n" + std::to_string(k), end,
                  {{"damping", chain[k].B}, {"flow_index", chain[k].n}});
      }
      const RunTable run = simulate(b.finish(2, 97, accuracy));
      const auto force = [&](double t) { return force_of(chain, v * std::sin(2 * std::numbers::pi * frequency * t)); };
      check_against(run, {"c0.force", force}, accuracy);
      check_against(run, {"n1.velocity", [&](double t) {
                            const double f = force(t);
                            return v * std::sin(2 * std::numbers::pi * frequency * t) -
                                   std::copysign(std::pow(std::abs(f) / chain[0].B, 1 / chain[0].n), f);
                          }},
                    accuracy);
    }
  }
}

}  // namespace rheonet::test::power_laws_at_rest_test
