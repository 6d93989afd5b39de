// A rigid link counted as a slider at its bound, for its bound is infinite: it began to slip at the first event elsewhere, with
// a force without end.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::rigid_link_holds_test {

TEST_CASE("a rigid link to what is moved holds through the events of others, either way round") {
  for (const char* ends : {"\"a\", \"b\"", "\"b\", \"a\""}) {
    const std::string moved = R"(
[elements]
drive = { type = "motion", at = "a", velocity = { sine = 0.7, frequency = 1.3 } }
b     = { type = "mass", at = "b", mass = 0.71 }
c     = { type = "mass", at = "c", mass = 0.43 }
)", stop = "[simulate]\nstop = 2.3\naccuracy = 1e-8\noutput = { points = 116 }\n";
    const RunTable linked = simulate(moved + fmt::format("link = {{ type = \"slider\", between = [{}], coulomb = \"inf\" }}\n", ends) +
                                       "rub = { type = \"slider\", between = [\"c\", \"b\"], coulomb = 0.53 }\n" + stop);
    const RunTable without = simulate(moved + "rub = { type = \"slider\", between = [\"c\", \"a\"], coulomb = 0.53 }\n" + stop);
    int turned = 0;
    for (std::size_t row = 1; row < linked.time().size(); ++row) {
      CHECK_EQ(linked["b.velocity"][row], linked["a.velocity"][row]);
      CHECK(std::abs(linked["c.velocity"][row] - without["c.velocity"][row]) < 1e-7);
      CHECK(std::abs(linked["link.force"][row]) < 0.71 * 0.7 * 8.17 + 0.54);
      if (linked["rub.force"][row] * linked["rub.force"][row - 1] < 0) ++turned;
    }
    CHECK_GT(turned, 3);
  }
}

// Motions that begin alike and part later were taken as they come, and the link with them.
TEST_CASE("a rigid link between motions: refused if they part, whenever that is") {
  const auto between = [](const std::string& one, const std::string& other) {
    return refusal("[elements]\nm = { type = \"motion\", at = \"a\", " + one + " }\nn = { type = \"motion\", at = \"b\", " + other + R"( }
link1 = { type = "slider", between = ["a", "c"], coulomb = "inf" }
link2 = { type = "slider", between = ["c", "b"], coulomb = "inf" }
c = { type = "mass", at = "c", mass = 1.3 }
[simulate]
stop = 1.7
)");
  };
  const auto torn = [](const char* v_b, const char* v_a, const char* t) {
    return fmt::format("rigid links `link1`, `link2` join node `b`, which motion `n` moves at {} m/s, to node `a`, which motion `m` moves "
                       "at {} m/s, at t = {} s; leave out a link or one of the motions",
                       v_b, v_a, t);
  };
  CHECK_EQ(between("velocity = { ramp = 0.7 }", "velocity = { ramp = 1.4 }"), torn("0.8806", "0.4403", "0.629"));
  CHECK_EQ(between("velocity = { ramp = 0.7 }", "velocity = { ramp = 0.7 }"), "");
  CHECK_EQ(between("velocity = { cosine = 0.7, offset = -0.7, frequency = 2 }", "velocity = { cosine = 0.8, offset = -0.8, frequency = 2 }"), torn("-0.840195", "-0.735171", "0.629"));
  CHECK_EQ(between("velocity = 0.4", "velocity = { table = [[0, 0.4], [1.1, 0.4], [1.2, 0.5]] }"), torn("0.437", "0.4", "1.137"));
  // The same in two ways: as a velocity, and as the position that it leads to.
  CHECK_EQ(between("velocity = { cosine = \"2*3.14159265358979324*1.3*0.2\", frequency = 1.3 }", "position = { sine = 0.2, frequency = 1.3 }"), "");
}

}  // namespace rheonet::test::rigid_link_holds_test
