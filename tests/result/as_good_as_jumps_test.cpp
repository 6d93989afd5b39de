#include <doctest/doctest.h>

#include <cmath>

#include "core/result/reference_solution.hpp"
#include "tests/support/simulate.hpp"
#include "tests/support/stored_rows.hpp"

namespace rheonet::test::as_good_as_jumps_test {

namespace {

/// A signal that goes from -1 to 1 within `lasts` [s], half of it before t = 0.5 s. There is a row at 0.5 s, and at each 0.1 s.
Scene crossing(double lasts) {
  return scene_of(R"([elements]
ramp = { type = "generator", signal = { ramp = 1, offset = -0.5 } }
steep = { type = "gain", in = "ramp", gain = )" + std::to_string(2 / lasts) + R"( }
cut = { type = "limiter", in = "steep", upper = 1 }
push = { type = "force", at = "block", force = { block = "cut" } }
block = { type = "mass", at = "block", mass = 1 }
[simulate]
stop = 1
output = { points = 11 }
record = ["cut.out", "ramp.out"]
)");
}

/// The error of a record that is `off` from the true one at 0.5 s.
double error(const Scene& scene, const ReferenceSolution& truth, std::size_t record, double off, double shift) {
  RowsInMemory rows = read_back(truth.rows);
  rows.values[5][record] += off;
  return record_errors(scene, stored(rows), truth, {.shift = shift})[record].largest;
}

}  // namespace

TEST_CASE("what is over within a hundredth of the time to the events around it is a jump") {
  // Half a second on either side.
  for (const double lasts : {4e-3, 6e-3}) {
    CAPTURE(lasts);
    const Scene scene = crossing(lasts);
    const ReferenceSolution truth = run_as_reference(scene, 0.01);
    const RowsInMemory rows = read_back(truth.rows);
    REQUIRE(std::abs(rows.times[5] - 0.5) < 1e-12);
    REQUIRE(std::abs(rows.values[5][0]) < 1e-6);
    const bool jumps = lasts < 5e-3;
    for (const double off : {0.7, -0.7, 1.0}) {
      CAPTURE(off);
      CHECK(std::abs(error(scene, truth, 0, off, 0.01) - (jumps ? 0 : std::abs(off))) < 1e-6);
      // A change that lasts longer than the allowed shift in time is not a jump.
      CHECK(std::abs(error(scene, truth, 0, off, 0.9 * lasts) - std::abs(off)) < 1e-6);
    }
    // It is at no place beyond what it goes between.
    CHECK(std::abs(error(scene, truth, 0, 1.3, 0.01) - (jumps ? 0.3 : 1.3)) < 1e-6);
    // A smooth record does not jump there.
    CHECK(std::abs(error(scene, truth, 1, 0.02, 0.01) - 0.02) < 1e-6);
  }
}

}  // namespace rheonet::test::as_good_as_jumps_test
