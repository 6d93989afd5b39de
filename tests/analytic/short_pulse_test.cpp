// Signals whose edges lie so close together that a double rounds the time between them: their integral is exact all the same.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/support/check.hpp"

namespace rheonet::test::short_pulse_test {

namespace {

std::string pushed(const std::string& force, double stop) {
  return fmt::format(R"(
[elements]
m = {{ type = "mass", at = "x", mass = 1.25 }}
f = {{ type = "force", at = "x", force = {} }}
[simulate]
stop   = {:.17g}
record = ["x.velocity"]
)", force, stop);
}

void check_final(const std::string& text, double velocity) {
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    CHECK(std::abs(simulate(text, accuracy)["x.velocity"].back() - velocity) <= 10 * accuracy * std::abs(velocity));
  }
}

}  // namespace

TEST_CASE("A pulse of 1e-12 s gives its momentum, however late it comes") {
  for (const double time : {0.0, 0.5, 7.3, 40.7}) {
    CAPTURE(time);
    for (const double width : {1e-12, 3.7e-10, 1e-6}) {
      CAPTURE(width);
      check_final(pushed(fmt::format("{{ pulse = {:.17g}, width = {:.17g}, time = {:.17g} }}", 1.25 / width, width, time), 2 * time + 1), 1);
    }
  }
}

TEST_CASE("Repeated short pulses give their momentum each") {
  check_final(pushed("{ pulse = 1e9, width = 1e-9, time = 0.3, frequency = 1.7 }", 11.3), 19 / 1.25);
}

TEST_CASE("A block that generates a short pulse gives it whole") {
  check_final(R"(
[elements]
g = { type = "generator", signal = { pulse = 1e12, width = 1e-12, time = 0.5 } }
m = { type = "mass", at = "x", mass = 1.25 }
f = { type = "force", at = "x", force = { block = "g" } }
[simulate]
stop   = 1
record = ["x.velocity"]
)", 0.8);
}

}  // namespace rheonet::test::short_pulse_test
