// A brake stops where an expression beside it switches, at rest: both events are at one time, and the brake is to stick whichever is found first.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/support/simulate.hpp"

namespace rheonet::test::stop_beside_switch_test {

namespace {

RunTable slowed_by(const std::string& drag, double velocity, double accuracy, const char* method) {
  return simulate(fmt::format(R"(
[parameters]
c = "1 N*s^2/m^2"
[laws.one-sided]
parameters = {{ b = "1 N*s/m", v = "1 m/s" }}
force = "w > 0*v ? b*w : 2*b*w"
[nodes]
a = {{ velocity = {} }}
[elements]
body  = {{ type = "mass", at = "a", mass = 1 }}
brake = {{ type = "slider", between = ["a", "ground"], coulomb = 1, breakaway = 1.5 }}
push  = {{ type = "force", at = "a", force = {{ sine = 0.2, frequency = 1.7, offset = 1.2 }} }}
{}
[simulate]
stop = 2
method = "{}"
output = {{ points = 41 }}
record = ["a.position", "a.velocity"]
)", velocity, drag, method), accuracy);
}

}  // namespace

TEST_CASE("a brake that stops where drag switches sticks, as with drag that does not switch") {
  const std::string square = "air = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 1, flow_index = 2 }";
  const std::string block = R"(
square = { type = "function", in = "a.velocity", out = "-c*abs(u1)*u1" }
air    = { type = "force", at = "a", force = { block = "square" } })";
  const std::string line = "air = { type = \"dashpot\", between = [\"a\", \"ground\"], damping = 2 }";
  const std::string law = "air = { type = \"one-sided\", between = [\"a\", \"ground\"] }";
  for (const auto& [smooth, switching] : {std::pair{square, block}, std::pair{line, law}}) {
    for (int k = 0; k < 23; ++k) {
      const double velocity = -1.05 + 0.031 * k;
      for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
        for (const char* method : {"auto", "ida"}) {
          CAPTURE(switching);
          CAPTURE(velocity);
          CAPTURE(accuracy);
          CAPTURE(method);
          const RunTable expected = slowed_by(smooth, velocity, 1e-10, "auto"), rows = slowed_by(switching, velocity, accuracy, method);
          REQUIRE_EQ(expected["a.velocity"].back(), 0);
          CHECK_EQ(rows["a.velocity"].back(), 0);
          CHECK_LE(std::abs(rows["a.position"].back() - expected["a.position"].back()), 10 * accuracy);
        }
      }
    }
  }
}

}  // namespace rheonet::test::stop_beside_switch_test
