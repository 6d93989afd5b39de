// Other people's published results with ideal sliders.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/references/reference.hpp"

namespace rheonet::test::friction_test {

namespace {

constexpr double accuracies[] = {1e-3, 1e-6, 1e-9};

std::string oscillator(const std::string& output) {
  return R"(
[elements]
mass   = { type = "mass", at = "block", mass = 1 }
spring = { type = "spring", between = ["block", "ground"], stiffness = 1 }
slider = { type = "slider", between = ["block", "ground"], coulomb = 1 }
[nodes]
block = { position = 12, velocity = 6 }
[simulate]
stop = 100
output = { )" +
         output + " }\n";
}

}  // namespace

// Their results come from steps of 0.01 s, and are as good as that.
TEST_CASE("Siconos: friction oscillator") {
  const auto theirs = reference("siconos-friction-oscillator.csv");
  if (!theirs) return;
  constexpr double every = 0.05, error = 2.5e-2;
  const RunTable ours = simulate(oscillator("every = 0.05"), 1e-8);
  for (std::size_t row = 0; row < theirs->time().size(); ++row) {
    const auto index = std::size_t(std::lround(theirs->time()[row] / every));
    REQUIRE_LT(std::abs(ours.time()[index] - theirs->time()[row]), 1e-9);
    CHECK_LE(std::abs(ours["block.position"][index] - (*theirs)["x"][row]), error);
    CHECK_LE(std::abs(ours["block.velocity"][index] - (*theirs)["v"][row]), error);
  }
}

// The same, exactly: swings about -1 and 1 in turn. The first has the amplitude sqrt(13^2 + 6^2), and is turned by
// atan(6/13); each turning point comes in by 2, and the eighth lies within 1.
TEST_CASE("Siconos: friction oscillator, exact") {
  const double first = std::atan2(6, 13), farthest = std::hypot(13, 6) - 1;
  CHECK_EQ(first, doctest::Approx(0.4324).epsilon(1e-4));
  CHECK_EQ(first + 7 * std::numbers::pi, doctest::Approx(22.4236).epsilon(1e-5));
  CHECK_EQ(14 - farthest, doctest::Approx(0.68218).epsilon(1e-5));
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const double error = accuracy * 100;  // of the run's length
    const RunTable rows = simulate(oscillator("points = 101, events = true"), accuracy);
    int turns = 0;
    double last = -1;
    for (std::size_t row = 1; row < rows.time().size(); ++row) {
      const double t = rows.time()[row];
      if (t != rows.time()[row - 1] || t == last) continue;
      CHECK_LE(std::abs(t - (first + turns * std::numbers::pi)), error);
      CHECK_LE(std::abs(rows["block.position"][row] - (turns % 2 ? -1 : 1) * (farthest - 2 * turns)),
               10 * accuracy * farthest);
      ++turns;
      last = t;
    }
    CHECK_EQ(turns, 8);
    const double stays = rows["block.position"].back();
    CHECK_LE(std::abs(stays - (14 - farthest)), 10 * accuracy * farthest);
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      if (rows.time()[row] < first + 7 * std::numbers::pi + error) continue;
      CHECK_EQ(rows["block.position"][row], stays);
      CHECK_EQ(rows["block.velocity"][row], 0);
    }
  }
}

// A. K. Chopra, Dynamics of Structures: an elastic-perfectly-plastic frame under half a sine (kip, inch, second). His
// table is that of the average acceleration method with steps of 0.1 s (OpenSees verifies itself against it); these are
// the exact values at the same times.
TEST_CASE("Chopra: elastic-perfectly-plastic frame, wired from a spring and a slider") {
  const double exact[] = {0, 0.0328, 0.2332, 0.6487, 1.1778, 1.7112, 2.1113, 2.2324, 2.0660, 1.6942};
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(R"toml(
[parameters]
m = 0.2533
k = 10
[elements]
push    = { type = "force", at = "floor", force = { sine = 10, frequency = "1/1.2" } }
release = { type = "force", at = "floor", force = { sine = 10, frequency = "1/1.2", time = 0.6 } }
inertia = { type = "mass", at = "floor", mass = "m" }
damper  = { type = "dashpot", between = ["floor", "ground"], damping = "2*0.05*sqrt(k*m)" }
[elements.frame]
between = ["floor", "ground"]
series = [ { type = "spring", stiffness = "k" }, { type = "slider", coulomb = 7.5 } ]
[simulate]
stop = 0.9
output = { every = 0.1 }
)toml",
                                     accuracy);
    REQUIRE_EQ(rows.time().size(), 10);
    for (std::size_t row = 0; row < 10; ++row) {
      CAPTURE(row);
      CHECK_LE(std::abs(rows["floor.position"][row] - exact[row]), 1e-4 + 10 * accuracy * 2.2324);
    }
    CHECK_LE(rows.scale("frame.force"), 7.5);
  }
}

}  // namespace rheonet::test::friction_test
