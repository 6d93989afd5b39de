#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_elements_test {

TEST_CASE("bad netlists: elements") {
  check_all({
      {"a parameter is missing",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"] }
)~",
       R"~(
scene.toml:2:1: error: a `spring` needs `stiffness`
    2 | k1 = { type = "spring", between = ["a", "ground"] }
      | ^
  a stiffness, in N/m
)~"},
      {"a key of the whole scene",
       R"~(
[elements]
k1 = { type = "spring", title = "rotation", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:25: error: unknown key `title` of a `spring`
    2 | k1 = { type = "spring", title = "rotation", between = ["a", "ground"], stiffness = 1 }
      |                         ^
  `title` belongs at the top of the file, above all tables: it is for the whole scene
)~"},
      {"the type is missing",
       R"~(
[elements]
k1 = { between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:1: error: element `k1` has no `type`
    2 | k1 = { between = ["a", "ground"], stiffness = 1 }
      | ^
  expected `type`, `series` or `parallel`
)~"},
      {"the type is mistyped as a key",
       R"~(
[elements]
k1 = { tpye = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:8: error: element `k1` has no `type`
    2 | k1 = { tpye = "spring", between = ["a", "ground"], stiffness = 1 }
      |        ^
  is `tpye` meant to be `type`?
)~"},
      {"a mistyped type",
       R"~(
[elements]
k1 = { type = "sprong", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:15: error: unknown element type `sprong`
    2 | k1 = { type = "sprong", between = ["a", "ground"], stiffness = 1 }
      |               ^
  did you mean `spring`?
)~"},
      {"a type that is like no other",
       R"~(
[elements]
k1 = { type = "gearbox", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:15: error: unknown element type `gearbox`
    2 | k1 = { type = "gearbox", between = ["a", "ground"], stiffness = 1 }
      |               ^
  the types that stand between nodes are `spring`, `dashpot`, `slider`, `force` and `torque`
)~"},
      {"a type that has another name elsewhere",
       R"~(
[elements]
k1 = { type = "Damper", between = ["a", "ground"], damping = 1 }
)~",
       R"~(
scene.toml:2:15: error: unknown element type `Damper`
    2 | k1 = { type = "Damper", between = ["a", "ground"], damping = 1 }
      |               ^
  it is called `dashpot` here
)~"},
      {"a mistyped key, not missing too",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stifness = 1 }
)~",
       R"~(
scene.toml:2:52: error: unknown key `stifness` of a `spring`
    2 | k1 = { type = "spring", between = ["a", "ground"], stifness = 1 }
      |                                                    ^
  did you mean `stiffness`?
)~"},
      {"a rotational type with keys that it has nowhere",
       R"~(
[elements]
m1 = { type = "inertia", at = "a", mass = 1, inertai = 2 }
[elements.g]
between = ["a", "ground"]
parallel = [{ type = "torque", name = "t", torque = 1, at = "a", torqe = 2 }]
)~",
       R"~(
scene.toml:2:36: error: `mass` is called `inertia` in a rotational scene
    2 | m1 = { type = "inertia", at = "a", mass = 1, inertai = 2 }
      |                                    ^
  write `inertia`
scene.toml:2:46: error: unknown key `inertai` of an `inertia`
    2 | m1 = { type = "inertia", at = "a", mass = 1, inertai = 2 }
      |                                              ^
  did you mean `inertia`?
scene.toml:5:56: error: a member of `series` or `parallel` has no `at`
    5 | parallel = [{ type = "torque", name = "t", torque = 1, at = "a", torqe = 2 }]
      |                                                        ^
  its place in the group says between which nodes it is
scene.toml:5:66: error: unknown key `torqe` of a `torque`
    5 | parallel = [{ type = "torque", name = "t", torque = 1, at = "a", torqe = 2 }]
      |                                                                  ^
  did you mean `torque`?
)~"},
      {"control characters in a name",
       R"~(
[elements]
"k\n\u001B[2J" = { type = "spring", between = ["a", "ground"], stiffness = 1 }
k2 = { type = "spring", between = ["a\u009B1m", "b\u202E"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:1: error: `k\n\u001B[2J` is no name for an element
    2 | "k\n\u001B[2J" = { type = "spring", between = ["a", "ground"], stiffness = 1 }
      | ^
  names are made of letters, digits, `_` and `-`
scene.toml:3:36: error: `a\u009B1m` is no name for a node
    3 | k2 = { type = "spring", between = ["a\u009B1m", "b\u202E"], stiffness = 1 }
      |                                    ^
  names are made of letters, digits, `_` and `-`
scene.toml:3:49: error: `b\u202E` is no name for a node
    3 | k2 = { type = "spring", between = ["a\u009B1m", "b\u202E"], stiffness = 1 }
      |                                                 ^
  names are made of letters, digits, `_` and `-`
)~"},
      {"a rotational name in translation",
       R"~(
[elements]
m1 = { type = "mass", at = "a", inertia = 1 }
)~",
       R"~(
scene.toml:2:33: error: `inertia` is called `mass` in a translational scene
    2 | m1 = { type = "mass", at = "a", inertia = 1 }
      |                                 ^
  write `mass`, or set domain = "rotation"
)~"},
      {"a translational name in rotation",
       R"~(
domain = "rotation"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
)~",
       R"~(
scene.toml:3:33: error: `mass` is called `inertia` in a rotational scene
    3 | m1 = { type = "mass", at = "a", mass = 1 }
      |                                 ^
  write `inertia`
)~"},
      {"one node too few",
       R"~(
[elements]
k1 = { type = "spring", between = ["a"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:35: error: `between` must name two nodes, but names 1
    2 | k1 = { type = "spring", between = ["a"], stiffness = 1 }
      |                                   ^
  between = ["a", "ground"]
)~"},
      {"a node without brackets",
       R"~(
[elements]
k1 = { type = "spring", between = "a", stiffness = 1 }
)~",
       R"~(
scene.toml:2:35: error: `between` must be an array, but is the string "a"
    2 | k1 = { type = "spring", between = "a", stiffness = 1 }
      |                                   ^
  between = ["a", "ground"]
)~"},
      {"a node twice",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "a"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:41: error: `between` names the node `a` twice
    2 | k1 = { type = "spring", between = ["a", "a"], stiffness = 1 }
      |                                         ^
  an element is between different nodes
)~"},
      {"`at` for `between`",
       R"~(
[elements]
k1 = { type = "spring", at = "a", stiffness = 1 }
)~",
       R"~(
scene.toml:2:25: error: `k1` is between two nodes, not `at` one
    2 | k1 = { type = "spring", at = "a", stiffness = 1 }
      |                         ^
  between = ["a", "ground"]
)~"},
      {"`between` for `at`",
       R"~(
[elements]
m1 = { type = "mass", between = ["a", "ground"], mass = 1 }
)~",
       R"~(
scene.toml:2:23: error: `m1` is `at` one node, not `between` several
    2 | m1 = { type = "mass", between = ["a", "ground"], mass = 1 }
      |                       ^
  at = "a"
)~"},
      {"no node",
       R"~(
[elements]
m1 = { type = "mass", mass = 1 }
)~",
       R"~(
scene.toml:2:1: error: `m1` needs `at`
    2 | m1 = { type = "mass", mass = 1 }
      | ^
  at = "a"
)~"},
      {"`at` and `between`",
       R"~(
[elements]
f1 = { type = "force", at = "a", between = ["a", "b"], force = 1 }
)~",
       R"~(
scene.toml:2:34: error: `f1` has both `at` and `between`
    2 | f1 = { type = "force", at = "a", between = ["a", "b"], force = 1 }
      |                                  ^
  only one of them can be given
)~"},
      {"an element that is no table",
       R"~(
[elements]
k1 = "spring"
)~",
       R"~(
scene.toml:2:6: error: element `k1` must be a table, but is the string "spring"
    2 | k1 = "spring"
      |      ^
  an element is a table: { type = "spring", ... }
)~"},
      {"a dot in a name",
       R"~(
[elements]
"k.1" = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:1: error: `k.1` is no name for an element
    2 | "k.1" = { type = "spring", between = ["a", "ground"], stiffness = 1 }
      | ^
  names are made of letters, digits, `_` and `-`
)~"},
      {"a space in the name of a node",
       R"~(
[elements]
k1 = { type = "spring", between = ["a b", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:36: error: `a b` is no name for a node
    2 | k1 = { type = "spring", between = ["a b", "ground"], stiffness = 1 }
      |                                    ^
  names are made of letters, digits, `_` and `-`
)~"},
      {"two of one_of",
       R"~(
[elements]
d = { type = "motion", at = "a", velocity = 1, position = 1 }
)~",
       R"~(
scene.toml:2:48: error: a `motion` has both `velocity` and `position`
    2 | d = { type = "motion", at = "a", velocity = 1, position = 1 }
      |                                                ^
  only one of them can be given
)~"},
      {"none of one_of",
       R"~(
[elements]
d = { type = "motion", at = "a" }
)~",
       R"~(
scene.toml:2:1: error: a `motion` needs `position` or `velocity`
    2 | d = { type = "motion", at = "a" }
      | ^
)~"},
      {"a node called as an element",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
a = { type = "spring", between = ["a", "b"], stiffness = 1 }
)~",
       R"~(
scene.toml:3:1: error: `a` is both an element between nodes and a node
    3 | a = { type = "spring", between = ["a", "b"], stiffness = 1 }
      | ^
  `a.velocity` would have two meanings: rename one of them
)~"},
      {"an element called ground",
       R"~(
[elements]
ground = { type = "spring", between = ["a", "b"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:1: error: an element cannot be called `ground`: that is the node that never moves
    2 | ground = { type = "spring", between = ["a", "b"], stiffness = 1 }
      | ^
)~"},
      {"every mistake is listed",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "2 mm" }
k2 = { type = "spring", between = ["a", "ground"], stiffnes = "2 N/m" }
k3 = { type = "sprin", between = ["a", "ground"], stiffness = "2 N/m" }
)~",
       R"~(
scene.toml:2:64: error: `stiffness`: expected a stiffness (N/m), found a length (m)
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "2 mm" }
      |                                                                ^
scene.toml:3:52: error: unknown key `stiffnes` of a `spring`
    3 | k2 = { type = "spring", between = ["a", "ground"], stiffnes = "2 N/m" }
      |                                                    ^
  did you mean `stiffness`?
scene.toml:4:15: error: unknown element type `sprin`
    4 | k3 = { type = "sprin", between = ["a", "ground"], stiffness = "2 N/m" }
      |               ^
  did you mean `spring`?
)~"},
  });
}

}  // namespace rheonet::test::bad_elements_test
