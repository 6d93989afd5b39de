// A jump of a drive that comes a rounding before the end of the run, or before that of another drive, left a stretch
// without time for a step.

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::break_at_the_stop_test {

TEST_CASE("breaks that differ from the stop, or from each other, by a rounding") {
  constexpr double v = 0.37, k = 137.3, Fc = 1.19, T = 0.31;
  for (const double nearby : {1.0, 1 - 1e-15, 1 + 1e-15}) {
    CAPTURE(nearby);
    SceneBuilder b;
    b.motion("drive", "a", "velocity", Signal(Signal::Square{v, 1 / T, 0, 0, 0}));
    b.between("k1", "spring", "a", "mid", {{"stiffness", k}});
    b.between("s1", "slider", "mid", "ground", {{"coulomb", Fc}, {"breakaway", Fc}});
    b.force("push", "mid", Signal(Signal::Step{0.5 * Fc, 1.5 * T * nearby, 0}));
    const RunTable run = simulate(b.finish(10 * T, 100, 1e-6));
    CHECK_EQ(run.time().back(), 10 * T);
    // Just before the last jump it slips backwards, under what the push leaves of the friction.
    CHECK(std::abs(run["k1.force"][99] - (-Fc - 0.5 * Fc)) < 1e-5);
  }
}

}  // namespace rheonet::test::break_at_the_stop_test
