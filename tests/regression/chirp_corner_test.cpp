#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::chirp_corner_test {

// The end of a chirp in position was taken for a step of the size of its rounding, because that was judged without the
// angle that it had gone through: a dashpot there was said to suffer an impulse.
TEST_CASE("the end of a fast chirp in position moves nothing in no time") {
  using namespace rheonet;
  test::SceneBuilder b;
  b.motion("shaker", "table", "position", Signal(Signal::Chirp{1e-3, 1, 900, 1.7, 0, 0.01, 1e-6}));
  b.at("m", "mass", "table", {{"mass", 1.3}});
  b.between("c", "dashpot", "table", "ground", {{"damping", 2.1}});
  b.motion("saw", "blade", "position", Signal(Signal::Triangle{1e-3, 900, 0, 0.01, 0}));
  b.between("c2", "dashpot", "blade", "ground", {{"damping", 2.1}});
  Summary summary;
  test::simulate(b.finish(1.72, 10, 1e-6), &summary);
  CHECK_EQ(fmt::format("{}", fmt::join(summary.notes, "\n")), "");
}

}  // namespace rheonet::test::chirp_corner_test
