#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

// A dilatant dashpot beside a pseudoplastic one, at a massless node: solved for its force, which near rest is far below
// every tolerance where its velocity is not, it took 40000 steps over each reversal of the force.
TEST_CASE("a dilatant dashpot beside a pseudoplastic one, under a force that reverses") {
  using namespace rheonet;
  constexpr double B1 = 0.5, n1 = 0.5, B2 = 1.178, n2 = 1.75;
  test::SceneBuilder b;
  b.force("drive", "end", Signal(Signal::Triangle{0.757, 1.584, 0, 0, 0}));
  b.between("e1", "dashpot", "end", "ground", {{"damping", B1}, {"flow_index", n1}});
  b.between("e2", "dashpot", "ground", "end", {{"damping", B2}, {"flow_index", n2}});
  Summary summary;
  const test::Trajectory run = test::simulate(b.finish(1.088, 60, 1e-6), &summary);
  CHECK(summary.steps < 3000);
  for (std::size_t i = 0; i < run.time().size(); ++i) {
    CAPTURE(run.time()[i]);
    const double w = run["end.velocity"][i], force = B1 * std::pow(std::abs(w), n1) + B2 * std::pow(std::abs(w), n2);
    CHECK(std::abs(std::copysign(force, w) - run["drive.force"][i]) < 1e-6 * run.scale("drive.force"));
  }
}
