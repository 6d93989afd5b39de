// A rack and a screw turn two wheels against each other, which rub on a disc. All three friction forces turn where the motion does.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::between_opposite_wheels_test {

namespace {

constexpr double radius = 0.76, lead = -2.8345, speed = 1.3, on_left = 1.3997, on_right = 1.286;

RunTable run(const std::string& wheels, double on_ground, const char* method) {
  return simulate(fmt::format(R"(
[elements]
{}
right_rubs = {{ type = "slider", between = ["disc", "right"], coulomb = {} }}
left_rubs = {{ type = "slider", between = ["disc", "left"], coulomb = {} }}
brake = {{ type = "slider", between = ["ground", "disc"], coulomb = {} }}
disc = {{ type = "inertia", at = "disc", inertia = 0.0275 }}
[simulate]
stop = 3
method = "{}"
output = {{ points = 61 }}
record = ["disc.velocity", "brake.force", "left_rubs.force", "right_rubs.force"]
)",
                              wheels, on_right, on_left, on_ground, method));
}

std::string triangle(double amplitude, double frequency) { return fmt::format("{{ triangle = {}, frequency = {} }}", amplitude, frequency); }

/// Both wheels turned by one motion.
std::string joined(double frequency) {
  return fmt::format(R"(drive = {{ type = "motion", at = "end", velocity = {} }}
rack = {{ type = "rack", between = ["left", "end"], radius = {} }}
screw = {{ type = "screw", between = ["right", "end"], lead = {} }})",
                     triangle(speed, frequency), radius, lead);
}

/// Each turned by a motion of its own, at the same speeds.
std::string separate(double frequency) {
  return fmt::format(R"(a = {{ type = "motion", at = "left", velocity = {}, domain = "rotation" }}
b = {{ type = "motion", at = "right", velocity = {}, domain = "rotation" }})",
                     triangle(speed / radius, frequency), triangle(speed * 2 * std::numbers::pi / lead, frequency));
}

}  // namespace

// The brake was taken to slip where the wheels turn: the run was refused.
TEST_CASE("a disc between wheels that turn against each other rests by its brake") {
  for (const char* method : {"exact", "ida"}) {
    for (int k = 0; k < 8; ++k) {
      const double frequency = 0.7713 + 0.1426 * k, on_ground = 0.712;
      CAPTURE(method);
      CAPTURE(frequency);
      const RunTable rows = run(joined(frequency), on_ground, method);
      for (std::size_t row = 0; row < rows.time().size(); ++row) {
        CAPTURE(rows.time()[row]);
        CHECK_EQ(rows["disc.velocity"][row], 0);
        CHECK_EQ(std::abs(rows["brake.force"][row]), doctest::Approx(on_left - on_right).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a disc that wheels drag along moves as it does with a motion for each wheel") {
  for (const char* method : {"exact", "ida"}) {
    for (const double on_ground : {0.05, 0.11}) {
      for (int k = 0; k < 4; ++k) {
        const double frequency = 0.7713 + 0.1426 * k;
        CAPTURE(method);
        CAPTURE(on_ground);
        CAPTURE(frequency);
        const RunTable one = run(joined(frequency), on_ground, method), two = run(separate(frequency), on_ground, method);
        REQUIRE_EQ(one.time().size(), two.time().size());
        double largest = 0, off = 0;
        for (std::size_t row = 0; row < one.time().size(); ++row) {
          largest = std::max(largest, std::abs(two["disc.velocity"][row]));
          off = std::max(off, std::abs(one["disc.velocity"][row] - two["disc.velocity"][row]));
        }
        CHECK_GT(largest, 1e-3);
        CHECK_LE(off, 1e-6 * largest);
      }
    }
  }
}

}  // namespace rheonet::test::between_opposite_wheels_test
