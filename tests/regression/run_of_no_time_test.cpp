#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::run_of_no_time_test {

// The time looked ahead at the start was a share of the run's, however short: springs between massless nodes were lost
// beside dashpots, and "it cannot be decided which sliders begin to slip" was said of a network without any.
TEST_CASE("a run far shorter than anything in the network takes: a ramp through springs and dashpots begins") {
  constexpr double k1 = 131, k2 = 57, V = 0.37;
  for (const double stop : {1e-6, 1e-9, 1e-12, 1e-15, 1e-18}) {
    CAPTURE(stop);
    const test::RunTable run = test::simulate(test::scene_of(fmt::format(R"([elements]
pull = {{ type = "motion", at = "end", velocity = {} }}
k1   = {{ type = "spring", between = ["end", "a"], stiffness = {} }}
c    = {{ type = "dashpot", between = ["a", "b"], damping = 3.7 }}
k2   = {{ type = "spring", between = ["b", "block"], stiffness = {} }}
c2   = {{ type = "dashpot", between = ["block", "far"], damping = 1.9 }}
c3   = {{ type = "dashpot", between = ["far", "ground"], damping = 0.9 }}
m    = {{ type = "mass", at = "block", mass = 0.37 }}
[simulate]
stop = {}
)", V, k1, k2, stop)));
    // To first order in time the dashpot does not move, and the springs share the displacement.
    CHECK(std::abs(run["k1.force"].back() / (k1 * k2 / (k1 + k2) * V * stop) - 1) < 1e-3 + 40 * stop);
    CHECK(std::abs(run["c.force"].back() / run["k2.force"].back() - 1) < 1e-9);
  }
}

}  // namespace rheonet::test::run_of_no_time_test
