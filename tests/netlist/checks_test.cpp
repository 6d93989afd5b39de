// [check]: comparisons between the parameters.
#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::checks_test {

namespace {

const std::string head = R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "k*(1 + 0*n*a/a*k_max/k_max)" }
[parameters]
k = "3 N/m"
k_max = "5 N/m"
a = "2 mm"
n = 7
[check]
)~";

/// The messages of a scene that is sound but for its checks.
std::string warnings(const std::string& checks, const ReadOptions& options = {}) {
  const ReadResult result = read(head + checks, options);
  CHECK_MESSAGE(result.scene, messages(result));
  return messages(result);
}

}  // namespace

TEST_CASE("checks: what holds says nothing") {
  CHECK(warnings(R"~(
soft = { that = "k < k_max", warn = "too stiff" }
also = { that = "k <= 3/5*k_max && (n == 7 || k > k_max)", error = "never" }
bare = "k*a < k_max*a"
chosen = "n > 3 ? k < k_max : k > k_max"
)~") == "");
}

TEST_CASE("checks: a warning has its place, its message and the values, and the scene is read") {
  CHECK(warnings("soft = { that = \"k > k_max\", warn = \"too soft\" }\n") ==
        R"~(scene.toml:9:17: warning: check `soft`: too soft
    9 | soft = { that = "k > k_max", warn = "too soft" }
      |                 ^
  `k > k_max` does not hold: k = 3 N/m, k_max = 5 N/m
)~");
  CHECK(warnings("\"soft enough\" = \"n < 7\"\n") == R"~(scene.toml:9:17: warning: check `soft enough` fails
    9 | "soft enough" = "n < 7"
      |                 ^
  `n < 7` does not hold: n = 7
)~");
}

TEST_CASE("checks: they see what --set has set, and can be set themselves") {
  const std::string check = "soft = { that = \"k < k_max\", warn = \"too stiff\" }\n";
  const auto with = [](const std::string& override) { return ReadOptions{{override}, {}, {}}; };
  CHECK(warnings(check, with("parameters.k=4 N/m")) == "");
  CHECK(warnings(check, with("parameters.k=5 N/m")).find("k = 5 N/m") != std::string::npos);
  CHECK(warnings(check, with("check.soft.that=n > 7")).find("`n > 7` does not hold") != std::string::npos);
}

TEST_CASE("bad netlists: checks") {
  const auto refused = [](const char* what, const std::string& checks, const std::string& expected) {
    INFO(what);
    CHECK('\n' + messages(read(head + checks)) == expected);
  };
  refused("one that is an error",
          R"~(soft = { that = "k < k/2", error = "too stiff" }
)~",
          R"~(
scene.toml:9:17: error: check `soft`: too stiff
    9 | soft = { that = "k < k/2", error = "too stiff" }
      |                 ^
  `k < k/2` does not hold: k = 3 N/m
)~");
  refused("mistyped keys, no comparison to make, two levels",
          R"~(a = { that = "k > k/2", wran = "too stiff" }
b = { warn = "too stiff" }
c = { that = "k > k/2", warn = "too soft", error = "much too soft" }
d = { that = "k > k/2", warn = true }
)~",
          R"~(
scene.toml:9:25: error: unknown key `wran` of check `a`
    9 | a = { that = "k > k/2", wran = "too stiff" }
      |                         ^
  did you mean `warn`?
scene.toml:10:1: error: check `b` needs `that`
   10 | b = { warn = "too stiff" }
      | ^
  laminar = { that = "speed < critical_speed", warn = "the flow would be turbulent" }
scene.toml:11:44: error: check `c` has both `warn` and `error`
   11 | c = { that = "k > k/2", warn = "too soft", error = "much too soft" }
      |                                            ^
  only one of them can be given: a run goes on after a warning
scene.toml:12:32: error: `warn` must be a string, but is `true`
   12 | d = { that = "k > k/2", warn = true }
      |                                ^
  it is the text that is shown where the comparison does not hold
)~");
  refused("not a comparison",
          R"~(a = "n"
b = "2*(n == 7)"
c = "3 mm"
d = 1
e = "0 < n < 3"
f = "n = 1"
)~",
          R"~(
scene.toml:9:5: error: check `a` must be a comparison, but is the string "n"
    9 | a = "n"
      |     ^
  laminar = { that = "speed < critical_speed", warn = "the flow would be turbulent" }
scene.toml:10:5: error: check `b` must be a comparison, but is the string "2*(n == 7)"
   10 | b = "2*(n == 7)"
      |     ^
  laminar = { that = "speed < critical_speed", warn = "the flow would be turbulent" }
scene.toml:11:5: error: check `c` must be a comparison, but is the string "3 mm"
   11 | c = "3 mm"
      |     ^
  laminar = { that = "speed < critical_speed", warn = "the flow would be turbulent" }
scene.toml:12:5: error: check `d` must be a string, but is the number 1
   12 | d = 1
      |     ^
  laminar = { that = "speed < critical_speed", warn = "the flow would be turbulent" }
scene.toml:13:12: error: check `e`: a comparison has two sides
   13 | e = "0 < n < 3"
      |            ^
  two of them are joined with `&&`: "0 < a && a < b"
scene.toml:14:8: error: check `f`: an expression cannot assign
   14 | f = "n = 1"
      |        ^
  `==` compares
)~");
  refused("unlike things, whether the numbers compare as wanted or not; unknown names; units",
          R"~(more  = "k > a"
less  = "k < a"
plain = "a > 3"
named = "k < bound"
unit  = "a < 3 mm"
)~",
          R"~(
scene.toml:9:14: error: check `more`: `k` is a stiffness (N/m), `a` is a length (m): they cannot be compared
    9 | more  = "k > a"
      |              ^
scene.toml:10:14: error: check `less`: `k` is a stiffness (N/m), `a` is a length (m): they cannot be compared
   10 | less  = "k < a"
      |              ^
scene.toml:11:14: error: check `plain`: `a` is a length (m), `3` is a pure number: they cannot be compared
   11 | plain = "a > 3"
      |              ^
  what has no unit counts as a pure number here: make it a parameter with its unit
scene.toml:12:14: error: check `named`: unknown name `bound`
   12 | named = "k < bound"
      |              ^
  it must be a parameter
scene.toml:13:16: error: check `unit`: there is no parameter `mm`, and a unit cannot stand in an expression
   13 | unit  = "a < 3 mm"
      |                ^
  `[parameters]` may define it: mm = ...; as a unit it stands behind one number and a space, "0.5 mm", and never in an expression
)~");
  check_all({{"a table that is none", R"~(
check = "n < 3"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
              R"~(
scene.toml:1:9: error: `check` must be a table, but is the string "n < 3"
    1 | check = "n < 3"
      |         ^
  laminar = { that = "speed < critical_speed", warn = "the flow would be turbulent" }
)~"}});
}

}  // namespace rheonet::test::checks_test
