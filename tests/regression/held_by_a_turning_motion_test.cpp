// A brake holds a mass to a motion, and another one rubs it against ground. Where the motion turns, the second one turns too.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/simulate.hpp"

namespace rheonet::test::held_by_a_turning_motion_test {

// The brake's force is then between those at which it slides and breaks away. It broke away at the turn or held, by the order of its ends.
TEST_CASE("a brake holds a mass to a motion that turns, whatever the order of its ends") {
  const double m = 0.083, v = 0.53, frequency = 2.07, omega = 2 * std::numbers::pi * frequency, rub = 0.81, sliding = 1.32, breakaway = 1.67;
  REQUIRE(rub + m * v * omega > sliding);
  REQUIRE(rub + m * v * omega < breakaway);
  for (const char* brake : {R"("end", "mass")", R"("mass", "end")"}) {
    for (const char* other : {R"("ground", "mass")", R"("mass", "ground")"}) {
      for (const char* method : {"exact", "ida"}) {
        for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
          CAPTURE(brake);
          CAPTURE(other);
          CAPTURE(method);
          CAPTURE(accuracy);
          const RunTable rows = simulate(fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "end", velocity = {{ cosine = {}, frequency = {} }} }}
brake = {{ type = "slider", between = [{}], coulomb = {}, breakaway = {} }}
rub = {{ type = "slider", between = [{}], coulomb = {} }}
m = {{ type = "mass", at = "mass", mass = {} }}
[nodes]
mass = {{ velocity = {} }}
[simulate]
stop = 1.2
method = "{}"
output = {{ points = 61 }}
record = ["mass.velocity"]
)",
                                                     v, frequency, brake, sliding, breakaway, other, rub, m, v, method),
                                         accuracy);
          double off = 0;
          for (std::size_t row = 0; row < rows.time().size(); ++row) off = std::max(off, std::abs(rows["mass.velocity"][row] - v * std::cos(omega * rows.time()[row])));
          CHECK_LE(off, accuracy * v);
        }
      }
    }
  }
}

}  // namespace rheonet::test::held_by_a_turning_motion_test
