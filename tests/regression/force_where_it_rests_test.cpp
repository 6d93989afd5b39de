#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::force_where_it_rests_test {

// The force of a slider that has come to rest is a small difference of much larger forces. Its error was as large as their tolerance.
TEST_CASE("where friction ends a swing of many times its force that force is as accurate as the swing") {
  constexpr double k = 210, Fc = 0.37, at_rest = 0.55;
  constexpr int half_swings = 60;
  const double x0 = (2 * half_swings + at_rest) * Fc / k;
  const char* const spring = "k = { type = \"spring\", between = [\"block\", \"ground\"], stiffness = 210 }\n";
  const char* const blocks = "press = { type = \"gain\", in = \"-block.position\", gain = 210 }\n"
                             "push = { type = \"force\", at = \"block\", force = { block = \"press\" } }\n";
  for (const char* const pull : {spring, blocks}) {
    for (const double accuracy : test::accuracies) {
      CAPTURE(pull);
      CAPTURE(accuracy);
      const std::string nodes = "[nodes]\nblock = { position = " + std::to_string(x0 * 1e6) + "e-6 }\n";
      const test::RunTable run = test::simulate(test::netlist({}, std::string(R"([elements]
block = { type = "mass", at = "block", mass = 0.14 }
friction = { type = "slider", between = ["block", "ground"], coulomb = 0.37 }
)") + pull + nodes,
                                                                5.2, 11),
                                                  accuracy);
      CHECK(run["block.velocity"].back() == 0);
      // It stops where it has turned the last time, on the side where it began. Ten thousand steps round as well.
      CHECK(std::abs(run["friction.force"].back() + at_rest * Fc) < 5 * accuracy * Fc + 1e-8 * Fc);
    }
  }
}

// A mass that comes from far away meets a stop, in which a small fraction of that distance is a large force.
TEST_CASE("a stop that blocks make is followed as its force asks for") {
  constexpr double v = 1.9, k = 2.3e6, m = 0.23, far = 5.1;
  const double w = std::sqrt(k / m), touch = far / v, gone = touch + std::numbers::pi / w;
  const auto force = [&](double t) { return t < touch || t > gone ? 0 : v * std::sqrt(k * m) * std::sin(w * (t - touch)); };
  test::check_at_all_accuracies(test::netlist({}, R"([elements]
ball = { type = "mass", at = "ball", mass = 0.23 }
press = { type = "gain", in = "-ball.position", gain = 2.3e6 }
contact = { type = "limiter", in = "press", lower = 0, upper = "inf" }
stop = { type = "force", at = "ball", force = { block = "contact" } }
[nodes]
ball = { position = 5.1, velocity = -1.9 }
)",
                                              2.687, 20001),
                                {{"stop.force", force}});
}

}  // namespace rheonet::test::force_where_it_rests_test
