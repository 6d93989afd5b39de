#include <doctest/doctest.h>

#include <vector>

#include "core/dae/inputs.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::reversal_on_zero_test {

// The search for a reversal that met the zero of the velocity exactly, as it does on a straight line, went on from
// there by a thousandth of the stretch and reported that instant.
TEST_CASE("a reversal that a search meets exactly is where it is") {
  using namespace rheonet;
  test::SceneBuilder b;
  b.motion("braked", "a", "velocity", Signal(Signal::Ramp{-0.5, 0, 0.25}));
  const Scene scene = b.finish(3, 10, 1e-6);
  const Network network = build_network(scene);
  Inputs inputs(network, classify(network), 0, {0, 0});
  inputs.enter(0);
  CHECK_EQ(inputs.next_reversal(0, -1, 0, 3), 0.5);
}

}  // namespace rheonet::test::reversal_on_zero_test
