// A cosine begins at rest: its rate there is 0, not the round-off of pi/2.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::cosine_start_test {

TEST_CASE("a motion that begins as a cosine, against dry friction") {
  constexpr double Fc = 0.5, X = 0.7;
  for (const char* motion : {"{ cosine = 0.7, frequency = 1 }", "{ sine = 0.7, frequency = 1, phase = \"90 deg\" }", "{ sine = -0.7, frequency = 1, phase = \"270 deg\" }"}) {
    CAPTURE(motion);
    for (const char* more : {"", ", stribeck = 0.1, peak = 2", ", breakaway = 0.8"}) {
      CAPTURE(more);
      const RunTable run = simulate(fmt::format(R"([elements]
e = {{ type = "motion", at = "a", position = {} }}
s = {{ type = "slider", between = ["a", "ground"], coulomb = {}{} }}
[nodes]
a = {{ position = {} }}
[simulate]
stop = 3.1
output = {{ points = 32 }}
)", motion, Fc, more, X), 1e-6);
      for (std::size_t row = 1; row < run.time().size(); ++row) {
        const double t = run.time()[row];
        if (std::abs(std::sin(2 * M_PI * t)) < 0.1) continue;
        CAPTURE(t);
        CHECK(run["s.force"][row] * std::sin(2 * M_PI * t) < 0);
        CHECK(std::abs(run["s.force"][row]) >= (1 - 1e-9) * Fc);
      }
      CHECK(run["a.velocity"].front() == 0);
    }
  }
}

}  // namespace rheonet::test::cosine_start_test
