// [expect]: claims as they are read.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::expect_table_test {

namespace {

const std::string head = R"~(
parameters.F = "2 N"
check.positive = "F > 0"
[elements]
drive = { type = "motion", at = "a", velocity = 1 }
k1 = { type = "spring", between = ["a", "mid"], stiffness = 1 }
c1 = { type = "dashpot", between = ["mid", "ground"], damping = 1 }
[simulate]
start = 1
stop = "3 s"
record = ["k1.force"]
[expect]
)~";

Scene expecting(const std::string& lines) { return sound_scene(head + lines); }

}  // namespace

TEST_CASE("claims: each figure, in SI, on records that need not be written") {
  using Figure = Claim::Figure;
  const Scene scene = expecting(R"~(
"k1.force" = [ { value = "F", at = "2 s", within = "1 mN" }, { max = "3*F", from = "1500 ms" }, { rms = 1, to = 2 } ]
mid.velocity = { final = ["2 mm/s", "3 mm/s"] }
"c1.displacement" = { crosses = "5 cm", at = "1.2 s", within = 1e-3 }
"c1.force" = { mean = 0.5, per = "c1.velocity" }
)~");
  REQUIRE(scene.records.size() == 1);
  REQUIRE(scene.claimed.size() == 5);
  REQUIRE(scene.claims.size() == 6);
  const auto of = [&](const Claim& claim) { return scene.claimed[std::size_t(claim.record)].path; };
  const auto& c = scene.claims;
  CHECK(of(c[0]) == "k1.force");
  CHECK(c[0].figure == Figure::at);
  CHECK(c[0].time == 2);
  CHECK(c[0].least == 2);
  CHECK(c[0].most == 2);
  CHECK(c[0].within == 1e-3);
  CHECK_FALSE(c[0].fraction);
  CHECK(c[0].per == -1);
  CHECK(c[1].record == c[0].record);
  CHECK(c[1].figure == Figure::max);
  CHECK(c[1].most == 6);
  CHECK(c[1].from == 1.5);
  CHECK(c[1].to == 3);
  CHECK(std::isnan(c[1].within));
  CHECK(c[2].figure == Figure::rms);
  CHECK(c[2].from == 1);
  CHECK(c[2].to == 2);
  CHECK(of(c[3]) == "mid.velocity");
  CHECK(c[3].least == doctest::Approx(2e-3));
  CHECK(c[3].most == doctest::Approx(3e-3));
  CHECK(c[3].within == 0);
  CHECK(c[4].figure == Figure::crossing);
  CHECK(c[4].level == doctest::Approx(0.05));
  CHECK(c[4].least == doctest::Approx(1.2));
  CHECK(c[4].fraction);
  CHECK(scene.claimed[std::size_t(c[5].per)].path == "c1.velocity");
  CHECK(scene.claimed[std::size_t(c[5].per)].channel == Record::Channel::velocity);
}

TEST_CASE("claims: a ratio has the quotient of the units") {
  CHECK(expecting("\"c1.force\" = { mean = \"5 N*s/mm\", per = \"c1.velocity\" }\n").claims[0].least ==
        doctest::Approx(5000));
  const std::string wrong = messages(read(head + "\"c1.force\" = { mean = \"5 N\", per = \"c1.velocity\" }\n"));
  CHECK_MESSAGE(wrong.find("error: `mean`: expected a damping (N*s/m), found a force (N)") != std::string::npos, wrong);
}

TEST_CASE("claims: what is mistaken elsewhere is not reported again") {
  const std::string once = messages(read(R"~(
[elements]
k1 = { type = "sprong", between = ["a", "ground"], stiffness = 1 }
[expect]
"k1.force" = { max = 1 }
)~"));
  CHECK(once.find("sprong") != std::string::npos);
  CHECK(once.find("expect") == std::string::npos);
}

TEST_CASE("bad netlists: claims") {
  const auto claims = [](const char* what, const std::string& lines, const std::string& expected) {
    INFO(what);
    const std::string begin =
        "[elements]\nk1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }\n[simulate]\nstop = "
        "1\n[expect]\n";
    CHECK('\n' + messages(read(begin + lines)) == expected);
  };
  claims("records of nothing", R"~("k2.force" = { max = 1 }
k1.torque = { max = 1 }
"a" = { max = 1 }
"k1.force" = { max = 1, per = "b.velocity" }
)~",
         R"~(
scene.toml:6:1: error: nothing is called `k2`
    6 | "k2.force" = { max = 1 }
      | ^
  did you mean `k1.force`?
scene.toml:7:4: error: `k1` has no `torque`
    7 | k1.torque = { max = 1 }
      |    ^
  did you mean `k1.force`?
scene.toml:8:1: error: `a` does not say which quantity is meant
    8 | "a" = { max = 1 }
      | ^
  for instance `a.force` of an element, `a.velocity` of a node
scene.toml:9:31: error: nothing is called `b`
    9 | "k1.force" = { max = 1, per = "b.velocity" }
      |                               ^
)~");
  claims("keys", R"~("k1.force" = [ { maks = 1 }, { within = 1 }, { max = 1, min = 0 } ]
"k1.velocity" = 3
"k1.displacement" = []
)~",
         R"~(
scene.toml:6:18: error: unknown key `maks` of a claim on `k1.force`
    6 | "k1.force" = [ { maks = 1 }, { within = 1 }, { max = 1, min = 0 } ]
      |                  ^
  did you mean `max`?
scene.toml:6:30: error: a claim on `k1.force` needs `value`, `final`, `max`, `min`, `mean`, `rms` or `crosses`
    6 | "k1.force" = [ { maks = 1 }, { within = 1 }, { max = 1, min = 0 } ]
      |                              ^
  "k1.force" = { at = "0.2 s", value = "2 N", within = 1e-6 }
scene.toml:6:57: error: a claim on `k1.force` has both `max` and `min`
    6 | "k1.force" = [ { maks = 1 }, { within = 1 }, { max = 1, min = 0 } ]
      |                                                         ^
  several claims on a record stand in brackets: [{ max = ... }, { min = ... }]
scene.toml:7:17: error: a claim on `k1.velocity` must be a table, but is the number 3
    7 | "k1.velocity" = 3
      |                 ^
  "k1.force" = { at = "0.2 s", value = "2 N", within = 1e-6 }
scene.toml:8:21: error: there is no claim on `k1.displacement`
    8 | "k1.displacement" = []
      |                     ^
  "k1.force" = { at = "0.2 s", value = "2 N", within = 1e-6 }
)~");
  claims("times", R"~("k1.force" = [
  { value = 1 },
  { value = 1, at = "2 s" },
  { max = 1, at = 0.5 },
  { final = 1, from = 0.5 },
  { max = 1, from = 0.7, to = 0.2 },
  { crosses = 1, at = -0.1 },
  { rms = 1, to = "3 m" },
]
)~",
         R"~(
scene.toml:7:5: error: `value` needs `at`, a time
    7 |   { value = 1 },
      |     ^
  "k1.force" = { at = "0.2 s", value = "2 N", within = 1e-6 }
scene.toml:8:21: error: `at` must be within the run, 0 s to 1 s, but is 2 s
    8 |   { value = 1, at = "2 s" },
      |                     ^
scene.toml:9:14: error: `at` goes with `value` or `crosses`, not with `max`
    9 |   { max = 1, at = 0.5 },
      |              ^
  `from` and `to` say where to look
scene.toml:10:16: error: `from` does not go with `final`
   10 |   { final = 1, from = 0.5 },
      |                ^
  it goes with `max`, `min`, `mean`, `rms` and `crosses`
scene.toml:11:31: error: `to` must be later than `from`, 0.7 s, but is 0.2 s
   11 |   { max = 1, from = 0.7, to = 0.2 },
      |                               ^
scene.toml:12:23: error: `at` must be within the run, 0 s to 1 s, but is -0.1 s
   12 |   { crosses = 1, at = -0.1 },
      |                       ^
scene.toml:13:19: error: `to`: expected a time (s), found a length (m)
   13 |   { rms = 1, to = "3 m" },
      |                   ^
)~");
  claims("values", R"~("k1.force" = [
  { max = "3 m" },
  { max = [1, 2, 3] },
  { max = [2, 1] },
  { max = [1, 2], within = 3 },
  { max = 1, within = "1 mm" },
  { max = 1, within = -1 },
  { max = "inf" },
  { max = true },
  { crosses = 1, at = 0.5, per = "k1.force" },
]
)~",
         R"~(
scene.toml:7:11: error: `max`: expected a force (N), found a length (m)
    7 |   { max = "3 m" },
      |           ^
scene.toml:8:11: error: `max` must be one value, or two in brackets between which it lies
    8 |   { max = [1, 2, 3] },
      |           ^
  max = ["1.9 N", "2.1 N"]
scene.toml:9:11: error: `max` must name the lesser of two values first
    9 |   { max = [2, 1] },
      |           ^
scene.toml:10:19: error: `within` does not go with two values, which say how far it may be
   10 |   { max = [1, 2], within = 3 },
      |                   ^
scene.toml:11:23: error: `within`: expected a force (N), found a length (m)
   11 |   { max = 1, within = "1 mm" },
      |                       ^
scene.toml:12:23: error: `within` must be at least 0 and finite, but is -1
   12 |   { max = 1, within = -1 },
      |                       ^
scene.toml:13:11: error: `max` must be finite, but is infinite
   13 |   { max = "inf" },
      |           ^
scene.toml:14:11: error: `max` must be a number or a string with a quantity or an expression, but is `true`
   14 |   { max = true },
      |           ^
scene.toml:15:15: error: a ratio has no `crosses`
   15 |   { crosses = 1, at = 0.5, per = "k1.force" },
      |               ^
  leave out `per`
)~");
  claims("a fraction of a ratio of nothing", R"~("k1.force" = [
  { mean = 0, per = "k1.velocity", within = 0.1 },
  { mean = "0*3", per = "k1.velocity" },
  { mean = 0, per = "k1.force", within = 0.1 },
  { mean = 0, per = "k1.velocity", within = "1 N*s/m" },
  { mean = [0, 0], per = "k1.velocity" },
  { mean = 1e-300, per = "k1.velocity", within = 0.1 },
  { mean = 0, within = 0.1 },
]
)~",
         R"~(
scene.toml:7:45: error: `within` allows a fraction of the claimed ratio, and that is 0
    7 |   { mean = 0, per = "k1.velocity", within = 0.1 },
      |                                             ^
  an absolute `within` has a unit, that of a damping (N*s/m); or two values say where it may lie: mean = [-1e-6, 1e-6]
scene.toml:8:12: error: `mean` without `within` allows a fraction of the claimed ratio, and that is 0
    8 |   { mean = "0*3", per = "k1.velocity" },
      |            ^
  an absolute `within` has a unit, that of a damping (N*s/m); or two values say where it may lie: mean = [-1e-6, 1e-6]
scene.toml:9:42: error: `within` allows a fraction of the claimed ratio, and that is 0
    9 |   { mean = 0, per = "k1.force", within = 0.1 },
      |                                          ^
  two values say where it may lie: mean = [-1e-6, 1e-6]
)~");
}

}  // namespace rheonet::test::expect_table_test
