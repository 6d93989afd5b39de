// A body that a moving plate has pushed leaves it where the force of the contact falls smoothly to 0.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::leaving_a_moving_plate_test {

namespace {

RunTable run_by(const char* method, double stiffness, double accuracy) {
  return simulate(fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "plate", velocity = {{ sine = 0.8, frequency = 0.76 }} }}
m = {{ type = "mass", at = "body", mass = 0.5 }}
k = {{ type = "spring", between = ["body", "ground"], stiffness = {} }}
c = {{ type = "dashpot", between = ["body", "ground"], damping = 0.091 }}
f = {{ type = "force", at = "body", force = {{ sine = -1.71, frequency = 1.57 }} }}
meet = {{ type = "stop", between = ["plate", "body"], upper = 0.14, stiffness = "inf" }}
[nodes]
body = {{ velocity = 0.8 }}
[simulate]
stop = 2.5
method = "{}"
record = ["body.position", "body.velocity"]
)", stiffness, method), accuracy);
}

}  // namespace

// There the displacement, its velocity and its acceleration are 0, and an error of a step may seem to close the contact again.
TEST_CASE("a body leaves a moving plate that has pushed it") {
  for (const double stiffness : {21.63, 20.9, 35.0}) {
    const RunTable exact = run_by("exact", stiffness, 1e-9);
    for (const double accuracy : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
      CAPTURE(stiffness);
      CAPTURE(accuracy);
      const RunTable rows = run_by("ida", stiffness, accuracy);
      for (const char* record : {"body.position", "body.velocity"}) {
        double off = 0;
        for (std::size_t row = 0; row < rows.time().size(); ++row) off = std::max(off, std::abs(rows[record][row] - exact[record][row]));
        CHECK_LE(off, 3 * accuracy * exact.scale(record));
      }
    }
  }
}

}  // namespace rheonet::test::leaving_a_moving_plate_test
