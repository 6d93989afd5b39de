// Beside a gear at a prescribed motion, a gear that shares a node with it was left with a factor of round-off where two of its factors cancel. Divided by that,
// the round-off of the velocities was a large dead band, and a slider there passed through rest without an event: it was pushed on by its own friction.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::gear_factors_that_cancel_test {

namespace {

struct Ratios { double of_two, of_three; };

std::string scene(const Ratios& ratios, bool reversed) {
  std::vector<std::string> elements{
      "drive = { type = \"motion\", at = \"end\", velocity = { table = [[0, -0.36], [0.18, 0.99], [0.4, -0.7]] } }\n",
      fmt::format("two = {{ type = \"gear\", between = [\"n3\", \"end\"], ratio = {} }}\n", ratios.of_two),
      "spring = { type = \"spring\", between = [\"n4\", \"n3\"], stiffness = 9.7 }\n",
      fmt::format("three = {{ type = \"gear\", between = [\"n3\", \"n2\"], ratio = {}, support = \"n4\" }}\n", ratios.of_three),
      "slider = { type = \"slider\", between = [\"n4\", \"end\"], coulomb = 0.63 }\n",
      "m2 = { type = \"mass\", at = \"n2\", mass = 0.074 }\n",
      "m3 = { type = \"mass\", at = \"n3\", mass = 0.042 }\n",
      "m4 = { type = \"mass\", at = \"n4\", mass = 0.039 }\n"};
  std::string text = "[elements]\n";
  for (std::size_t k = 0; k < elements.size(); ++k) text += elements[reversed ? elements.size() - 1 - k : k];
  return text + "[simulate]\nstop = 0.4\noutput = { points = 41 }\n";
}

}  // namespace

TEST_CASE("a slider beside two gears stops, whichever gear comes first") {
  for (const Ratios& ratios : {Ratios{0.690629289698653, 1.0720303342008657}, Ratios{0.69, 1.07}, Ratios{1.0 / 3, 0.7}, Ratios{-0.7, 1.9}}) {
    CAPTURE(ratios.of_two);
    const RunTable one = simulate(scene(ratios, false)), other = simulate(scene(ratios, true));
    CHECK(largest_error(other, one) <= 1e-9);
    for (const RunTable* rows : {&one, &other}) {
      const auto &force = (*rows)["slider.force"], &velocity = (*rows)["slider.velocity"];
      for (std::size_t i = 0; i < force.size(); ++i) CHECK(force[i] * velocity[i] >= -1e-12);
    }
  }
}

}  // namespace rheonet::test::gear_factors_that_cancel_test
