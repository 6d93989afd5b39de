// A law of the netlist takes the small difference of two velocities. Its round-off must not decide the steps.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::law_in_a_moving_frame_test {

namespace {

RunTable shaken(double frame, double accuracy, Summary& summary) {
  return simulate(scene_of(fmt::format(R"(
[laws.hysteresis]
parameters = {{ k = "3 N/m", D = "0.01 m", n = 1.5 }}
states = {{ z = {{ start = "0 m", rate = "w - 0.5*abs(w)*z/D*(abs(z)/D)^(n - 1) - 0.5*w*(abs(z)/D)^n" }} }}
force = "k*z"
[nodes]
p = {{ velocity = {0} }}
a = {{ velocity = {0} }}
[elements]
m    = {{ type = "mass", at = "a", mass = 1 }}
belt = {{ type = "motion", at = "p", acceleration = {{ sine = 1, frequency = 0.5 }} }}
b    = {{ type = "hysteresis", between = ["p", "a"] }}
[simulate]
stop = 2
accuracy = {1}
output = {{ points = 41 }}
record = ["a.velocity", "b.force"]
)", frame, accuracy)), &summary);
}

}  // namespace

TEST_CASE("a box at rest on a belt that begins to accelerate: the same in a moving frame, in as many steps") {
  for (const double accuracy : {1e-4, 1e-6, 1e-7, 1e-8, 1e-9}) {
    CAPTURE(accuracy);
    Summary at_rest, moving;
    const RunTable still = shaken(0, accuracy, at_rest);
    for (const double frame : {0.7, -31.0}) {
      CAPTURE(frame);
      const RunTable rows = shaken(frame, accuracy, moving);
      double largest = 0, force = 0;
      for (std::size_t row = 0; row < rows.time().size(); ++row) {
        largest = std::max(largest, std::abs(rows["b.force"][row] - still["b.force"][row]));
        force = std::max(force, std::abs(still["b.force"][row]));
      }
      CHECK_LE(largest, 10 * accuracy * force);
      CHECK_LE(moving.steps, 2 * at_rest.steps);
    }
  }
}

}  // namespace rheonet::test::law_in_a_moving_frame_test
