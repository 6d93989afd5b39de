// An error that ends a run names the elements to look at, the time, and the remedy, even in the smallest network.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::failure_report_test {

namespace {

/// A mass that a force drives, and a spring where it has a stiffness.
std::string refused(const Signal& force, double stiffness, double stop) {
  SceneBuilder b;
  b.at("m", "mass", "a", {{"mass", 0.7}});
  b.force("push", "a", force);
  if (stiffness > 0) b.between("k", "spring", "a", "ground", {{"stiffness", stiffness}});
  return attempt(b.finish(stop, 10, 1e-6)).refusal;
}

Signal sine(double frequency) { return Signal(Signal::Sine{.amplitude = 1.3, .frequency = frequency, .phase = 0, .time = 0, .offset = 0}); }

}  // namespace

TEST_CASE("what changes too fast is told with all that has a part in it, at the one node and at two") {
  CHECK_EQ(refused(sine(1), 0, 1), "");
  CHECK_EQ(refused(sine(1e300), 0, 1),
           "at t = 0 s the velocity of node `a` changes faster than double precision can follow at this accuracy; check the values of "
           "`m`, `push`, or ask for a looser accuracy");
  CHECK_EQ(refused(sine(1), 130, 1), "");
  CHECK_EQ(refused(sine(1e300), 130, 1),
           "at t = 0 s the velocity of node `a` changes faster than double precision can follow at this accuracy; check the values of "
           "`m`, `push`, `k`, or ask for a looser accuracy");
}

// Where all motion is given, the one equation that keeps the integrator going belongs to no node and no element: it was looked
// up as the state of a block.
TEST_CASE("where all motion is given a run that cannot go on is told with the motion and what it moves") {
  const auto refusal_of = [](const Signal& velocity, double stop) {
    SceneBuilder b;
    b.motion("drive", "a", "velocity", velocity);
    b.between("c", "dashpot", "a", "ground", {{"damping", 1.7}});
    return attempt(b.finish(stop, 10, 1e-6)).refusal;
  };
  const auto square = [](double phase) { return Signal(Signal::Square{.amplitude = 1, .frequency = 3, .phase = phase, .time = 0, .offset = 0}); };
  CHECK_EQ(refusal_of(square(1e3), 1), "");
  for (const std::string& refusal : {refusal_of(square(1e300), 1), refusal_of(Signal(Signal::Constant{1}), 1e-320),
                                     refusal_of(Signal(Signal::Ramp{1e300, 0, 0}), 1e10)}) {
    CAPTURE(refusal);
    const bool named = refusal.find("`drive`") != std::string::npos || refusal.find("`c.force`") != std::string::npos;
    CHECK((refusal.empty() || named));
  }
}

TEST_CASE("forces beyond all numbers are told as such where nothing can slip") {
  const Signal peak(Signal::Table{.times = {0, 1, 1.5}, .values = {0, 1e308, 0}, .time = 0, .offset = 0});
  CHECK_EQ(refused(peak, 0, 2), 
           "at t = 1 s it cannot be decided what moves which way: forces differ by rounding only, or lie beyond the range of double "
           "precision; check the values of `m`, `push`, or ask for another accuracy");
}

TEST_CASE("a step in position whose shares rounding hides is told with the motion and the dashpots") {
  const auto refusal_of = [](double thick, double thin) {
    SceneBuilder b;
    b.motion("m", "a", "position", Signal(Signal::Step{1.1, 0.3, 0}));
    b.between("d1", "dashpot", "a", "b", {{"damping", thick}, {"flow_index", 3}});
    b.between("d2", "dashpot", "b", "c", {{"damping", thin}, {"flow_index", 3}});
    b.between("d3", "dashpot", "c", "ground", {{"damping", 1}, {"flow_index", 3}});
    return attempt(b.finish(1, 10, 1e-6)).refusal;
  };
  CHECK_EQ(refusal_of(3, 2), "");
  CHECK_EQ(refusal_of(1e300, 1e-300),
           "at t = 0.3 s rounding hides how dashpots `d1`, `d2`, `d3` share the step in position of `m`: their values lie too far "
           "apart; give the step a time to rise in");
}

}  // namespace rheonet::test::failure_report_test
