#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_groups_test {

TEST_CASE("bad netlists: series, parallel and repeat") {
  check_all({
      {"what stands at a node, in series",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ { type = "mass", mass = 1 }, { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:3:21: error: a `mass` stands at a node: it cannot be a member of `series` or `parallel`
    3 | series = [ { type = "mass", mass = 1 }, { type = "spring", stiffness = 1 } ]
      |                     ^
  give it an entry of its own in [elements], with `at`
)~"},
      {"nodes within a group",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ { type = "spring", between = ["a", "b"], stiffness = 1 } ]
)~",
       R"~(
scene.toml:3:31: error: a member of `series` or `parallel` has no `between`
    3 | series = [ { type = "spring", between = ["a", "b"], stiffness = 1 } ]
      |                               ^
  its place in the group says between which nodes it is
)~"},
      {"a name twice in an assembly, in any depth",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ { name = "k", type = "spring", stiffness = 1 }, { parallel = [ { name = "k", type = "spring", stiffness = 1 } ] } ]
)~",
       R"~(
scene.toml:3:84: error: the name `k` stands twice in this assembly
    3 | ... = [ { name = "k", type = "spring", stiffness = 1 }, { parallel = [ { name = "k", type = "spring", stiffness = 1 } ] } ]
      |                                                                                 ^
  names within an assembly must differ
)~"},
      {"a name that an unnamed member has",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ { name = "spring1", type = "spring", stiffness = 1 }, { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:3:66: error: the name `spring1` stands twice in this assembly
    3 | series = [ { name = "spring1", type = "spring", stiffness = 1 }, { type = "spring", stiffness = 1 } ]
      |                                                                  ^
  an unnamed member is called by its type and number: name one of them otherwise
)~"},
      {"a name that an inner node has",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ { name = "node1", type = "spring", stiffness = 1 }, { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:3:21: error: `node1` is the name of an inner node of this assembly
    3 | series = [ { name = "node1", type = "spring", stiffness = 1 }, { type = "spring", stiffness = 1 } ]
      |                     ^
  choose another name
)~"},
      {"an empty group",
       R"~(
[elements.g]
between = ["a", "ground"]
series = []
)~",
       R"~(
scene.toml:3:10: error: `series` has no members
    3 | series = []
      |          ^
)~"},
      {"a type and a group",
       R"~(
[elements.g]
between = ["a", "ground"]
type = "spring"
series = [ { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:4:1: error: element `g` has both `type` and `series`
    4 | series = [ { type = "spring", stiffness = 1 } ]
      | ^
  a group in a group is a member of its own: series = [ { parallel = [ ... ] }, ... ]
)~"},
      {"a group without brackets",
       R"~(
[elements.g]
between = ["a", "ground"]
series = { type = "spring", stiffness = 1 }
)~",
       R"~(
scene.toml:3:10: error: `series` must be an array, but is a table
    3 | series = { type = "spring", stiffness = 1 }
      |          ^
  a group lists its members: series = [ { type = "spring", ... }, ... ]
)~"},
      {"names of elements for members",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ "k1", "k2" ]
)~",
       R"~(
scene.toml:3:12: error: a member of a group must be a table, but is the string "k1"
    3 | series = [ "k1", "k2" ]
      |            ^
  an element is a table: { type = "spring", ... }
scene.toml:3:18: error: a member of a group must be a table, but is the string "k2"
    3 | series = [ "k1", "k2" ]
      |                  ^
  an element is a table: { type = "spring", ... }
)~"},
      {"series mistyped",
       R"~(
[elements.g]
between = ["a", "ground"]
serie = [ { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:3:1: error: element `g` has no `type`
    3 | serie = [ { type = "spring", stiffness = 1 } ]
      | ^
  is `serie` meant to be `series`?
)~"},
      {"a parameter of a group",
       R"~(
[elements.g]
between = ["a", "ground"]
stiffness = 3
series = [ { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:3:1: error: unknown key `stiffness` of a `series` group
    3 | stiffness = 3
      | ^
  its keys are `between`, `domain`, `repeat` and `series`
)~"},
      {"a wrong value deep within",
       R"~(
[elements.g]
between = ["a", "ground"]
series = [ { type = "spring", stiffness = 1 }, { parallel = [ { type = "spring", stiffness = "1 N" } ] } ]
)~",
       R"~(
scene.toml:3:94: error: `stiffness`: expected a stiffness (N/m), found a force (N)
    3 | series = [ { type = "spring", stiffness = 1 }, { parallel = [ { type = "spring", stiffness = "1 N" } ] } ]
      |                                                                                              ^
)~"},
      {"a model with one port in series",
       R"~(
[models.m]
ports = ["a"]
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = 1 } }
[elements.g]
between = ["a", "ground"]
series = [ { type = "m" }, { type = "spring", stiffness = 1 } ]
)~",
       R"~(
scene.toml:6:12: error: model `m` has 1 port: a member of `series` or `parallel` needs two
    6 | series = [ { type = "m" }, { type = "spring", stiffness = 1 } ]
      |            ^
)~"},
      {"repeats",
       R"~(
[elements]
a = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 0 } }
b = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 2.5 } }
c = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = "2 m" } }
d = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { as = "j" } }
e = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = 3 }
f = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 3, as = "n" } }
g = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 3, arrange = "paralel" } }
h = { type = "mass", at = "x", mass = 1, repeat = { count = 3, arrange = "series" } }
i = { type = "spring", between = ["x", "ground"], stiffness = "k*(j+1)", repeat = { count = 3 } }
j = { type = "spring", between = ["x", "ground"], stiffness = "2-i", repeat = { count = 5 } }
)~",
       R"~(
scene.toml:2:85: error: `count` must be a whole number of at least 1, but is 0
    2 | a = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 0 } }
      |                                                                                     ^
scene.toml:3:85: error: `count` must be a whole number of at least 1, but is 2.5
    3 | b = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 2.5 } }
      |                                                                                     ^
scene.toml:4:85: error: `count`: expected a number without a unit, found a length (m)
    4 | c = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = "2 m" } }
      |                                                                                     ^
scene.toml:5:66: error: `repeat` needs `count`
    5 | d = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { as = "j" } }
      |                                                                  ^
  repeat = { count = 10 }
scene.toml:6:75: error: `repeat` must be a table, but is the number 3
    6 | e = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = 3 }
      |                                                                           ^
  repeat = { count = 10, as = "i", arrange = "series" }
scene.toml:7:93: error: `as` cannot be `n`: that is the count
    7 | f = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 3, as = "n" } }
      |                                                                                             ^
  choose another name
scene.toml:8:98: error: `arrange` must be `series` or `parallel`, but is `paralel`
    8 | g = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 3, arrange = "paralel" } }
      |                                                                                                  ^
  did you mean `parallel`?
scene.toml:9:74: error: only what is between two nodes can be repeated in series
    9 | h = { type = "mass", at = "x", mass = 1, repeat = { count = 3, arrange = "series" } }
      |                                                                          ^
  arrange = "parallel"
scene.toml:10:64: error: `stiffness`: unknown name `k` (in `i.0`)
   10 | i = { type = "spring", between = ["x", "ground"], stiffness = "k*(j+1)", repeat = { count = 3 } }
      |                                                                ^
  it must be a parameter
scene.toml:11:63: error: `stiffness` must be greater than 0, but is 0 (in `j.2`)
   11 | j = { type = "spring", between = ["x", "ground"], stiffness = "2-i", repeat = { count = 5 } }
      |                                                               ^
)~"},
      {"a huge repeat",
       R"~(
[elements]
a = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 10000000 } }
)~",
       R"~(
scene.toml:2:85: error: this `repeat` makes 10000000 elements; a scene may have at most 5000000
    2 | a = { type = "spring", between = ["x", "ground"], stiffness = 1, repeat = { count = 10000000 } }
      |                                                                                     ^
)~"},
      {"a huge product of repeats",
       R"~(
[models.m]
ports = ["a", "b"]
elements = { k = { type = "spring", between = ["a", "b"], stiffness = 1, repeat = { count = 10000 } } }
[elements]
a = { type = "m", between = ["x", "ground"], repeat = { count = 1000 } }
b = { type = "m", between = ["x", "ground"], repeat = { count = 1000 } }
)~",
       R"~(
scene.toml:5:65: error: this `repeat` makes 10000000 elements; a scene may have at most 5000000 (in `a`)
    5 | a = { type = "m", between = ["x", "ground"], repeat = { count = 1000 } }
      |                                                                 ^
)~"},
  });
}

}  // namespace rheonet::test::bad_groups_test
