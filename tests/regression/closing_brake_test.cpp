// A brake closes on a mass that has come to rest, but for the errors of steps: it sticks. It slipped for some nanoseconds once, and the row at that
// time held its sliding force.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::closing_brake_test {

TEST_CASE("a brake that closes on a mass that has settled holds it at once") {
  const double k = 870, load = 13.7, coulomb = 41;
  const auto settled = [&](double held, double accuracy) {
    return simulate(fmt::format(R"(
[elements]
m = {{ type = "mass", at = "a", mass = 1.3 }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = {0} }}
c = {{ type = "dashpot", between = ["a", "ground"], damping = 37 }}
load = {{ type = "force", at = "a", force = {{ step = {1}, time = 3, offset = {2} }} }}
brake = {{ type = "slider", between = ["a", "ground"], coulomb = {{ step = {3}, time = 3 }} }}
[nodes]
a = {{ velocity = 2 }}
[simulate]
method = "ida"
stop = 4
output = {{ every = 0.25 }}
)", k, held, load, coulomb), accuracy);
  };
  for (const double accuracy : {1e-2, 1e-3, 1e-4, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    for (const double held : {-7.9, 0.0, 29.0}) {
      CAPTURE(held);
      const RunTable rows = settled(held, accuracy);
      CHECK(std::abs(rows["brake.force"][12] - held) <= accuracy * coulomb);
      CHECK(std::abs(rows["brake.force"][11]) <= 1e-9);
    }
    // One that cannot hold the load slips on.
    const RunTable rows = settled(60, accuracy);
    CHECK(rows["brake.force"][12] == doctest::Approx(coulomb));
    CHECK(rows["a.position"][13] - rows["a.position"][12] > (60 - coulomb) / k);
  }
}

}  // namespace rheonet::test::closing_brake_test
