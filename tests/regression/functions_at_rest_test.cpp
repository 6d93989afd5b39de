// While friction holds a node, its velocity is exactly 0: functions of it have their values at 0, not those of the side from which it came.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::functions_at_rest_test {

TEST_CASE("functions of the velocity of a node that sticks are those of 0") {
  const RunTable rows = simulate(R"toml([elements]
m  = { type = "mass", at = "x", mass = 2 }
F  = { type = "force", at = "x", force = { sine = "5 N", frequency = "0.5 Hz" } }
fr = { type = "slider", between = ["x", "ground"], coulomb = 3 }
s  = { type = "function", in = ["x.velocity"], out = "sign(u1)" }
ge = { type = "function", in = ["x.velocity"], out = "u1 >= 0 ? 1 : 0" }
le = { type = "function", in = ["x.velocity"], out = "u1 <= 0 ? 1 : 0" }
gt = { type = "function", in = ["x.velocity"], out = "u1 > 0 ? 1 : 0" }
lt = { type = "function", in = ["x.velocity"], out = "u1 < 0 ? 1 : 0" }
lk = { type = "lookup", in = "x.velocity", table = [[-1, 5], [0, 5], [0, 3], [1, 3]] }
[simulate]
stop = "3.9 s"
output = { points = 391 }
)toml", 1e-6);
  int at_rest = 0, forward = 0, backward = 0;
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    const double v = rows["x.velocity"][row], sign = v > 0 ? 1 : v < 0 ? -1 : 0;
    ++(v > 0 ? forward : v < 0 ? backward : at_rest);
    CAPTURE(rows.time()[row]);
    CHECK_EQ(rows["s.out"][row], sign);
    CHECK_EQ(rows["ge.out"][row], v >= 0);
    CHECK_EQ(rows["le.out"][row], v <= 0);
    CHECK_EQ(rows["gt.out"][row], v > 0);
    CHECK_EQ(rows["lt.out"][row], v < 0);
    CHECK_EQ(rows["lk.out"][row], v < 0 ? 5 : 3);
  }
  CHECK(at_rest > 10);
  CHECK(forward > 10);
  CHECK(backward > 10);
}

// Pushed forward only, the mass never feels the friction of the way back: it moves as with the friction of the way forward both ways.
TEST_CASE("friction that is stronger on the way back, which a mass never takes") {
  const auto motion = [](int back) {
    return simulate(fmt::format(R"toml([elements]
m  = {{ type = "mass", at = "x", mass = 2 }}
F  = {{ type = "force", at = "x", force = {{ sine = "2.25 N", frequency = "1 Hz", offset = "2.25 N" }} }}
fr = {{ type = "slider", between = ["x", "ground"], coulomb = {{ block = "c" }} }}
c  = {{ type = "function", in = ["x.velocity"], out = "u1 >= 0 ? way : back" }}
[parameters]
way = "3 N"
back = "{} N"
[simulate]
stop = "3 s"
)toml", back), 1e-9);
  };
  const RunTable stronger = motion(5), alike = motion(3);
  for (std::size_t row = 0; row < alike.time().size(); ++row) CHECK_LE(std::abs(stronger["x.velocity"][row] - alike["x.velocity"][row]), 1e-9);
  CHECK(alike["x.position"].back() > 0.2);
}

// A law that resists on the way back alone, beside friction that holds.
TEST_CASE("a law with a jump at rest has its force at rest while friction holds it") {
  const RunTable rows = simulate(R"toml([laws.ratchet]
parameters = { P = "1 N" }
force = "w < 0 ? -P : 0*P"
[elements]
m  = { type = "mass", at = "x", mass = 2 }
F  = { type = "force", at = "x", force = { sine = "2.25 N", frequency = "1 Hz", offset = "2.25 N" } }
fr = { type = "slider", between = ["x", "ground"], coulomb = 3 }
r  = { type = "ratchet", between = ["x", "ground"] }
[simulate]
stop = "2 s"
)toml", 1e-6);
  for (std::size_t row = 0; row < rows.time().size(); ++row) CHECK_EQ(rows["r.force"][row], 0);
  CHECK(rows.scale("x.velocity") > 0.1);
}

}  // namespace rheonet::test::functions_at_rest_test
