#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::power_law_from_rest_test {

// A network that starts from rest with a drive whose velocity begins at 0 has not moved yet to first order. Where a power
// law is infinitely steep at rest the network then seemed to be fast without bounds, and tolerances came to 1e-37.
TEST_CASE("a dilatant dashpot behind springs that creep, from rest and from a moving frame") {
  using namespace rheonet;
  constexpr double v = 0.371, accuracy = 1e-6;
  const auto run = [&](double frame, Summary& summary) {
    test::SceneBuilder b;
    b.motion("carrier", "base", "velocity", Signal(Signal::Constant{frame}));
    for (const char* node : {"n1", "n2"}) b.start(node, 0, frame);
    b.motion("drive", "end", "velocity", Signal(Signal::Sine{-1.207, 1.619, 0, 0, frame}));
    b.between("e1", "vfm", "n1", "end", {{"stiffness", 42.53}, {"damping", 2.077}});
    b.between("e2", "vfm", "n2", "n1", {{"stiffness", 43.60}, {"damping", 0.7173}});
    b.between("e3", "dashpot", "n2", "base", {{"damping", 1.070}, {"flow_index", 1.75}});
    return test::simulate(b.finish(1.073, 60, accuracy), &summary);
  };
  Summary rest, moving;
  const test::RunTable one = run(0, rest), other = run(v, moving);
  CHECK(rest.steps < 5000);
  CHECK(moving.steps < 2 * rest.steps);
  for (std::size_t i = 0; i < one.time().size(); ++i) {
    CAPTURE(one.time()[i]);
    CHECK(std::abs(other["e3.force"][i] - one["e3.force"][i]) < 10 * accuracy * one.scale("e3.force"));
  }
}

}  // namespace rheonet::test::power_law_from_rest_test
