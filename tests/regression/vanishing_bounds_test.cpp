#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::vanishing_bounds_test {

// Sliders stick together while the bound of one of them falls to 0. Almost no force acts at a node then, and its balance
// cannot be better than the round-off of the larger forces beside it: "the forces cannot be balanced" was the answer.
TEST_CASE("sliders hold a load while the bound of one of them vanishes") {
  const RunTable rows = simulate(R"([elements]
m0 = { type = "mass", at = "n0", mass = 1.44 }
m1 = { type = "mass", at = "n1", mass = 2.87 }
push = { type = "force", at = "n1", force = 3 }
s0 = { type = "slider", between = ["n1", "n0"], coulomb = 0.63, normal = 1 }
s1 = { type = "slider", between = ["n1", "ground"], coulomb = 0.36, normal = 3 }
s2 = { type = "slider", between = ["n1", "ground"], coulomb = 0.24, normal = 8.1 }
s3 = { type = "slider", between = ["n0", "n1"], coulomb = 0.52, normal = { sine = 8.095, frequency = 0.543, phase = 2.81, offset = 6.588 } }
[simulate]
stop = 4
output = { every = 0.04 }
record = ["n0.velocity", "n1.velocity", "s1.force", "s2.force"]
)");
  for (std::size_t i = 0; i < rows.time().size(); ++i) {
    CHECK(rows["n0.velocity"][i] == 0);
    CHECK(rows["n1.velocity"][i] == 0);
    // 3 N: the first takes all it can, 1.08 N, as half of the load is more.
    CHECK(std::abs(rows["s1.force"][i] - 1.08) < 1e-12);
    CHECK(std::abs(rows["s2.force"][i] - 1.92) < 1e-12);
  }
}

TEST_CASE("a brake lets go of two masses that a freewheel and a slider join") {
  const RunTable rows = simulate(R"([elements]
m0 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
push = { type = "force", at = "b", force = -5 }
w0 = { type = "freewheel", between = ["b", "a"] }
w1 = { type = "freewheel", between = ["b", "ground"] }
s0 = { type = "slider", between = ["a", "ground"], coulomb = { ramp = -4, offset = 6 } }
s1 = { type = "slider", between = ["a", "b"], coulomb = 1 }
[simulate]
stop = 4
output = { every = 0.04 }
record = ["a.velocity", "b.velocity"]
)");
  for (const char* node : {"a.velocity", "b.velocity"}) CHECK(rows.scale(node) == 0);
}

TEST_CASE("a step in position that turns a freewheel backwards is refused") {
  const auto scene = [](const std::string& step) {
    return "[elements]\nx = { type = \"motion\", at = \"a\", position = { step = " + step + ", time = 1 } }\n"
           "w = { type = \"freewheel\", between = [\"b\", \"a\"] }\nm = { type = \"mass\", at = \"b\", mass = 1 }\n"
           "[simulate]\nstop = 2\n";
  };
  CHECK(refusal(scene("0.125")).find("at t = 1 s a step in position turns `w` backwards by 0.125 m in no time") != std::string::npos);
  CHECK(refusal(scene("-0.125")).empty());
}

// Two freewheels hold a mass between ground and a driven node. At rest both stick; which of them opens when the driven node
// moves on, only the laws can say: the one whose free direction it is.
TEST_CASE("a mass between two freewheels follows the driven node, and never goes back") {
  const RunTable rows = simulate(R"([elements]
m = { type = "mass", at = "b", mass = 1 }
p = { type = "motion", at = "a", velocity = { sine = 1, frequency = 0.5 } }
w1 = { type = "freewheel", between = ["b", "ground"] }
w2 = { type = "freewheel", between = ["b", "a"] }
push = { type = "force", at = "b", force = -5 }
[simulate]
stop = 4
output = { every = 0.04 }
record = ["a.velocity", "b.velocity", "w1.force", "w2.force"]
)");
  for (std::size_t i = 0; i < rows.time().size(); ++i) {
    CAPTURE(rows.time()[i]);
    CHECK(std::abs(rows["b.velocity"][i] - std::max(0.0, rows["a.velocity"][i])) < 1e-5);
    CHECK(rows["w1.force"][i] < 1e-5);
    CHECK(rows["w2.force"][i] < 1e-5);
  }
}

}  // namespace rheonet::test::vanishing_bounds_test
