#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::turning_together_test {

// `e5` and `e8` go between the same two points while `e9` rests. Each had a reversal of its own, and the first to turn was
// turned back by the second, without end.
TEST_CASE("laws that friction at rest keeps together turn together") {
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    const Scene scene = test::scene_of(R"([elements]
drive = { type = "force", at = "end", force = { cosine = 1.0656, frequency = 2.1173 } }
e1 = { type = "cfm", between = ["n3", "n4"], stiffness = 16.94, damping = 1.136, coulomb = 0.4656, exponent = 2 }
e3 = { type = "spring", between = ["n2", "n4"], stiffness = 44.09 }
e4 = { type = "vfm", between = ["n2", "n1"], stiffness = 33.5, damping = 1.457 }
e5 = { type = "sfm", between = ["n1", "n3"], stiffness = 12.62, coulomb = 0.442, exponent = 1.5 }
e6 = { type = "sfm", between = ["ground", "n2"], stiffness = 51.86, coulomb = 0.6967, exponent = 0 }
e7 = { type = "cfm", between = ["end", "ground"], stiffness = 21.29, damping = 2.907, coulomb = 2.389, exponent = 1.5 }
e8 = { type = "sfm", between = ["n3", "end"], stiffness = 7.151, coulomb = 1.526, exponent = 0.5 }
e9 = { type = "cfm", between = ["n1", "end"], stiffness = 26.73, damping = 2.445, coulomb = 0.4044, exponent = 0.5 }
[simulate]
stop = 1.005
output = { points = 61 }
)",
                                       accuracy);
    Summary summary;
    test::simulate(scene, &summary);
    CHECK(summary.events < 100);
    CHECK(std::abs(summary.missing) <= 10 * accuracy * summary.largest);
  }
}

// The velocity at the event, within the margin of the guard, was larger than any change that a pseudoplastic dashpot allows in a moment. So the
// friction did not come to rest and reversed thousands of times.
TEST_CASE("friction rests beside a pseudoplastic dashpot") {
  for (const double n : {0.7, 0.8, 1.0}) {
    CAPTURE(n);
    const Scene scene = test::scene_of(R"([elements]
drive = { type = "force", at = "end", force = { table = [[0, -0.5277], [0.1222, 0.815], [0.3385, -1.4187], [0.5819, -0.486]] } }
e1 = { type = "dashpot", between = ["end", "ground"], damping = 0.695, flow_index = )" + std::to_string(n) + R"( }
e2 = { type = "sfm", between = ["ground", "end"], stiffness = 9.615, coulomb = 0.8038, exponent = 1.5 }
e3 = { type = "cfm", between = ["ground", "end"], stiffness = 11.53, damping = 1.375, coulomb = 0.4831, exponent = 0.5 }
[simulate]
stop = 0.58
output = { points = 581 }
)",
                                       1e-6);
    Summary summary;
    const test::RunTable run = test::simulate(scene, &summary);
    CHECK(summary.events < 20);
    const auto& v = run["end.velocity"];
    CHECK(std::count(v.begin(), v.end(), 0.0) >= 5);
  }
}

namespace {

/// The events of a scene are what they are, however loose the accuracy.
void check_events(const std::string& toml, long events) {
  for (const double accuracy : {1e-2, 1e-3, 1e-6}) {
    CAPTURE(accuracy);
    Summary summary;
    test::simulate(test::scene_of(toml, accuracy), &summary);
    CHECK(summary.events == events);
  }
}

}  // namespace

// Friction in parallel with a slider turned a little before the slider, which then slipped back and forth over thousands of stops.
TEST_CASE("a slider that turns with friction beside it comes to rest with it") {
  check_events(R"([elements]
drive = { type = "motion", at = "end", position = { table = [[0, 0], [0.1312, -0.04566], [0.2907, 0.07795], [0.4436, -0.08659], [0.6243, 0.08726], [0.7345, -0.07884]] } }
e1 = { type = "slider", between = ["n1", "end"], coulomb = 1.5079 }
e2 = { type = "sfm", between = ["n1", "ground"], stiffness = 7.9718, coulomb = 0.56763, exponent = 2 }
e3 = { type = "dashpot", between = ["ground", "n1"], damping = 2.2194 }
m_n1 = { type = "mass", at = "n1", mass = 0.060029 }
[simulate]
stop = 0.8128
output = { points = 61 }
)",
               17);
}

// The end of friction that has stopped was stopped without the node that other friction at rest held there.
TEST_CASE("friction comes to rest with what friction at rest holds to it") {
  check_events(R"([elements]
drive = { type = "force", at = "end", force = { triangle = -1.336, frequency = 2.4807 } }
e1 = { type = "dashpot", between = ["n1", "end"], damping = 0.74181 }
e2 = { type = "cfm", between = ["n2", "n1"], stiffness = 53.81, damping = 0.84993, coulomb = 0.70939, exponent = 2 }
e3 = { type = "cfm", between = ["n2", "ground"], stiffness = 56.687, damping = 0.77364, coulomb = 1.0832, exponent = 2 }
m_end = { type = "mass", at = "end", mass = 0.046533 }
[simulate]
stop = 1.1934
output = { points = 61 }
)",
               26);
}

// Friction at rest was let go, and had come to rest again, within one step: its event functions had fallen below zero and come
// back, and nothing looked between the ends of the step.
TEST_CASE("friction at rest is let go for less than a step") {
  check_events(R"([elements]
drive = { type = "motion", at = "end", velocity = { table = [[0, -0.47702], [0.12278, 1.0129], [0.26815, -1.3885], [0.49523155322747525, -0.37532], [0.49523155322747525, 1.0143903], [0.65107, -0.69402], [0.80337, 1.4933]] } }
e1 = { type = "cfm", between = ["end", "n1"], stiffness = 35.529, damping = 2.9457446, coulomb = 1.63686, exponent = 2 }
e2 = { type = "spring", between = ["n1", "ground"], stiffness = 18.34956 }
e3 = { type = "vfm", between = ["ground", "end"], stiffness = 9.8875, damping = 2.0441 }
[simulate]
stop = 0.8917452586173243
output = { points = 61 }
)",
               15);
}

}  // namespace rheonet::test::turning_together_test
