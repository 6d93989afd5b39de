#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::rate_beyond_numbers_test {

// A rate that overflows was reported as a balance of forces that cannot be found. Elimination spreads the overflow to all rates of the same
// system, and the error named the first unknown, not the unknown whose equation causes it.
TEST_CASE("a rate beyond the range of double precision is told, with the node whose rate it is") {
  const std::string told = " changes at a rate beyond the range of double precision";
  const std::string end = "\n[simulate]\nstop = 1\naccuracy = 1e-6\n";
  SUBCASE("one mass, under a step of a force") {
    const std::string refusal = rheonet::test::refusal(R"([elements]
push = { type = "force", at = "a", force = { step = 1e200, time = 0.1 } }
m = { type = "mass", at = "a", mass = 1e-200 }
k = { type = "spring", between = ["a", "ground"], stiffness = 3.0 }
c = { type = "dashpot", between = ["a", "ground"], damping = 2.0 }
)" + end);
    CHECK_MESSAGE(refusal.starts_with("at t = 0.1 s the velocity of node `a`" + told), refusal);
  }
  SUBCASE("the second of two masses, whose equations are finite both") {
    const std::string refusal = rheonet::test::refusal(R"([nodes]
b = { velocity = 1.7 }
[elements]
m1 = { type = "mass", at = "a", mass = 0.4 }
k1 = { type = "spring", between = ["a", "ground"], stiffness = 3.0 }
m2 = { type = "mass", at = "b", mass = 1e-200 }
c = { type = "dashpot", between = ["b", "a"], damping = 1e150 }
)" + end);
    CHECK_MESSAGE(refusal.starts_with("at t = 0 s the velocity of node `b`" + told), refusal);
  }
  SUBCASE("a hundred decades less run") {
    CHECK(rheonet::test::refusal(R"([elements]
push = { type = "force", at = "a", force = { step = 1e100, time = 0.1 } }
m = { type = "mass", at = "a", mass = 1e-100 }
c = { type = "dashpot", between = ["a", "ground"], damping = 2e-100 }
)" + end) == "");
  }
}

}  // namespace rheonet::test::rate_beyond_numbers_test
