// Where the force of a gear with losses comes to 0 beside a brake that sticks, the force that both agree on is of the other sign than before.
// Trials that began at the old one led nowhere.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::lossy_gear_turns_beside_friction_test {

TEST_CASE("a gear with losses whose driving side changes beside a brake that sticks") {
  for (int k = 0; k < 20; ++k) {
    const std::string text = fmt::format(R"([elements]
m_n0 = {{ type = "mass", at = "n0", mass = 6 }}
m_n2 = {{ type = "mass", at = "n2", mass = 0.6767 }}
g0 = {{ type = "lever", between = ["n0", "n1"], ratio = 4.3, efficiency = [0.889, 0.227] }}
k1 = {{ type = "spring", between = ["n1", "n2"], stiffness = 259.4 }}
k2 = {{ type = "spring", between = ["n2", "ground"], stiffness = 481.8 }}
br0 = {{ type = "slider", between = ["n1", "ground"], coulomb = 0.17 }}
q0 = {{ type = "force", at = "n0", force = {{ ramp = 0.7759 }} }}
[nodes]
n2 = {{ velocity = {} }}
[simulate]
stop = 4
output = {{ points = 41 }}
)", -1.62 - 0.01 * k);
    CAPTURE(text);
    Summary summary;
    const RunTable exact = simulate(scene_of(text), &summary);
    CHECK_LE(std::abs(summary.missing), 1e-12 * summary.largest);
    Scene by_ida = scene_of(text, 1e-9);
    by_ida.method = Scene::Method::ida;
    CHECK_LE(largest_error(simulate(by_ida), exact), 1e-7);
  }
}

}  // namespace rheonet::test::lossy_gear_turns_beside_friction_test
