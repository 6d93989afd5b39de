#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::thin_power_law_test {

// A light mass dragged along by a strongly pseudoplastic dashpot lags by a velocity that is far smaller than its own:
// w = (m a/B)^(1/n). Taken as a difference of the two, it has too few digits for the force B w^n.
TEST_CASE("the force of a pseudoplastic dashpot on a light mass") {
  using namespace rheonet;
  for (const double n : {0.5, 0.3, 0.2, 0.1, 0.05}) {
    CAPTURE(n);
    constexpr double accuracy = 1e-6, m = 0.1, B = 1.3;
    test::SceneBuilder b;
    b.motion("drive", "a", "velocity", Signal(Signal::Sine{0.23, 1.7, 0.4, 0, 0}));
    b.between("c", "dashpot", "a", "b", {{"damping", B}, {"flow_index", n}});
    b.at("m", "mass", "b", {{"mass", m}});
    Summary summary;
    test::simulate(b.finish(1.7, 10, accuracy), &summary);
    CHECK_MESSAGE(std::abs(summary.missing) <= 10 * accuracy * summary.largest,
                  "missing " << summary.missing << " of " << summary.largest);
  }
}

}  // namespace rheonet::test::thin_power_law_test
