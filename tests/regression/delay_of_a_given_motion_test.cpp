#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::delay_of_a_given_motion_test {

// Steps were no longer than a delay: one of 1e-10 s made 1e10 of them.
TEST_CASE("a delay costs no steps, of what is given and of what moves freely") {
  constexpr double B = 0.7, T1 = 0.1, V = 1.3;
  const auto run = [&](double delay, const char* other) {
    Summary summary;
    const test::RunTable rows = test::simulate(
        test::scene_of(fmt::format(R"([elements]
drive = {{ type = "motion", at = "shaft", velocity = {{ step = {}, time = 0.1 }} }}
soon  = {{ type = "vfm", between = ["shaft", "{}"], damping = {}, stiffness = {}, delay = {} }}
m     = {{ type = "mass", at = "block", mass = 1e9 }}
k     = {{ type = "spring", between = ["block", "ground"], stiffness = 1 }}
[simulate]
stop = 0.5
)",
                                   V, other, B, B / T1, delay)),
        &summary);
    CHECK(std::abs(rows["soon.force"].back() - B * V * (1 - std::exp(-(0.4 - delay) / T1))) <= 1e-6 * B * V);
    return summary.steps;
  };
  const long steps = run(1e-10, "ground");
  CHECK(steps < 1000);
  CHECK(run(1e-4, "ground") < 2 * steps);
  CHECK(run(1e-4, "block") < 2 * steps);
  CHECK(run(1e-10, "block") < 2 * steps);
}

}  // namespace rheonet::test::delay_of_a_given_motion_test
