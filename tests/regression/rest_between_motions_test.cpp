#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::rest_between_motions_test {

namespace {

constexpr double sigma = 17.9, B = 3.59, stop = 0.31;

/// Friction in series with a sticking slider, between two driven nodes that come to relative rest at t = stop.
std::string scene(double frame, const std::string& beside) {
  const auto number = [](double x) { return std::to_string(x); };
  return test::netlist({}, R"([elements]
drive = { type = "motion", at = "end", velocity = { table = [[0, )" + number(0.58 + frame) + "], [" + number(stop) + ", " + number(0.58 + frame) + "], [" +
                               number(stop) + ", " + number(frame) + "], [1, " + number(frame) + R"(]] } }
base = { type = "motion", at = "base", velocity = )" + number(frame) + R"( }
friction = { type = "cfm", between = ["end", "mid"], stiffness = 17.9, damping = 3.59, coulomb = 2.1, exponent = 0.5 }
holder = { type = "slider", between = ["mid", "base"], coulomb = 2.3 }
)" + beside,
                       1, 101);
}

}  // namespace

// An element connected to a slider was not recognised as at rest between two motions. The friction kept the direction s of its earlier motion,
// in place of s = 0 at rest, and relaxed with the wrong slope.
TEST_CASE("friction behind a slider that sticks is at rest where what moves them is") {
  for (const double frame : {0.0, 0.71}) {
    for (const double accuracy : test::accuracies) {
      CAPTURE(frame);
      CAPTURE(accuracy);
      const test::RunTable run = test::simulate(scene(frame, ""), accuracy);
      REQUIRE(std::abs(run.time()[31] - stop) < 1e-12);
      const double f = run["friction.force"][31];
      CHECK(f > 1);
      for (std::size_t k = 31; k < run.time().size(); ++k) {
        CAPTURE(run.time()[k]);
        CHECK(std::abs(run["friction.force"][k] - f * std::exp(-sigma / B * (run.time()[k] - stop))) < 2 * accuracy * f);
      }
    }
  }
}

// Beside such friction a slider at rest between two motions was let slip, as it is between nodes whose forces balance: what
// its force is depended on whether others were integrated along with it.
TEST_CASE("a slider at rest between two motions has no force, whatever is beside it") {
  for (const char* keep : {"", "parts"}) {
    for (const double frame : {0.0, 0.71}) {
      CAPTURE(keep);
      CAPTURE(frame);
      Scene whole = test::scene_of(scene(frame, "beside = { type = \"slider\", between = [\"end\", \"base\"], coulomb = 1.34 }\n"));
      if (*keep) whole.keep.push_back(keep);
      const test::RunTable run = test::simulate(whole);
      CHECK(run["beside.force"][30] == 1.34);
      for (std::size_t k = 31; k < run.time().size(); ++k) CHECK(run["beside.force"][k] == 0);
    }
  }
}

}  // namespace rheonet::test::rest_between_motions_test
