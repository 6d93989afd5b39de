// [exact]: closed forms of records.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::analytic_solutions_test {

namespace {

const std::string head = R"~([parameters]
F = "2 N"
tau = "0.5 s"
t0 = "1.5 s"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 4 }
c1 = { type = "dashpot", between = ["a", "ground"], damping = 3 }
pull = { type = "motion", at = "a", velocity = 1 }
[simulate]
start = 1
stop = "3 s"
record = ["k1.force", "c1.force", "a.velocity"]
[exact]
)~";

}  // namespace

TEST_CASE("closed forms: expressions over parameters and the time, in SI") {
  const Scene scene = sound_scene(head + R"~("k1.force" = "F*exp(-t/tau)"
c1.force = "t < t0 ? 0 : F*(t - t0)/tau"
"a.velocity" = 1
)~");
  REQUIRE(scene.exact.size() == 3);
  CHECK(scene.exact[0].record == 0);
  CHECK(scene.exact[0].value(1.7) == doctest::Approx(2 * std::exp(-3.4)));
  CHECK(scene.exact[1].record == 1);
  CHECK(scene.exact[1].value(1.4999) == 0);
  CHECK(scene.exact[1].value(1.5) == 0);
  CHECK(scene.exact[1].value(1.75) == doctest::Approx(1));
  CHECK(scene.exact[2].value(2) == 1);
  CHECK(scene.exact[2].spot.line == 16);
}

TEST_CASE("closed forms follow parameters that are set, and have no value where they have none") {
  ReadOptions options;
  options.overrides = {"parameters.tau=0.25 s"};
  const Scene scene = sound_scene(head + "\"k1.force\" = \"F*sqrt((t - t0)/tau)\"\n", options);
  REQUIRE(scene.exact.size() == 1);
  CHECK(scene.exact[0].value(2.5) == doctest::Approx(4));
  CHECK(std::isnan(scene.exact[0].value(1.25)));
}

TEST_CASE("without units in a scene the time has none either") {
  const Scene scene = sound_scene(R"~([elements]
m = { type = "mass", at = "a", mass = 1 }
[nodes]
a = { velocity = 3 }
[simulate]
stop = 1
[exact]
"a.position" = "3*t"
)~");
  REQUIRE(scene.exact.size() == 1);
  CHECK(scene.exact[0].value(0.5) == doctest::Approx(1.5));
}

TEST_CASE("bad closed forms") {
  const auto said_of = [](const std::string& lines) { return messages(read(head + lines)); };
  CHECK_EQ(said_of(R"~("k1.force" = "F*exp(-t)"
"c1.force" = "F*t"
"a.velocity" = "G*t"
"k1.velocity" = 1
"k9.force" = 1
)~"),
           R"~(scene.toml:14:21: error: `k1.force`: `exp` takes a pure number, but `-t` is a time (s)
   14 | "k1.force" = "F*exp(-t)"
      |                     ^
scene.toml:15:14: error: `c1.force`: expected a force (N), found a quantity in kg*m*s^-1
   15 | "c1.force" = "F*t"
      |              ^
scene.toml:16:17: error: `a.velocity`: unknown name `G`
   16 | "a.velocity" = "G*t"
      |                 ^
  it must be a parameter
scene.toml:17:1: error: `k1.velocity` is not recorded
   17 | "k1.velocity" = 1
      | ^
  add it to `record` in [simulate]
scene.toml:18:1: error: nothing is called `k9`
   18 | "k9.force" = 1
      | ^
  did you mean `k1.force`?
)~");
  CHECK_EQ(said_of("\"k1.force\" = true\n"),
           R"~(scene.toml:14:14: error: `k1.force` must be a number or a string with a quantity or an expression, but is `true`
   14 | "k1.force" = true
      |              ^
)~");
}

}  // namespace rheonet::test::analytic_solutions_test
