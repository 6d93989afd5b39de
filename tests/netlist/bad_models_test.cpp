#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_models_test {

TEST_CASE("bad netlists: models") {
  check_all({
      {"a model called as a type",
       R"~(
[models.spring]
ports = ["a", "b"]
elements = { k = { type = "dashpot", between = ["a", "b"], damping = 1 } }
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:1:9: error: `spring` is an element type already
    1 | [models.spring]
      |         ^
  a model needs a name of its own
)~"},
      {"models in a circle",
       R"~(
[models.inner]
ports = ["a", "b"]
elements = { k = { type = "outer", between = ["a", "b"] } }
[models.outer]
ports = ["a", "b"]
elements = { k = { series = [ { type = "inner" } ], between = ["a", "b"] } }
[elements]
k1 = { type = "outer", between = ["a", "ground"] }
)~",
       R"~(
scene.toml:1:9: error: models contain each other in a circle: `inner` -> `outer` -> `inner`
    1 | [models.inner]
      |         ^
)~"},
      {"a model within itself",
       R"~(
[models.m]
ports = ["a", "b"]
elements = { k = { type = "m", between = ["a", "b"] } }
[elements]
k1 = { type = "m", between = ["a", "ground"] }
)~",
       R"~(
scene.toml:1:9: error: models contain each other in a circle: `m` -> `m`
    1 | [models.m]
      |         ^
)~"},
      {"no ports",
       R"~(
[models.m]
elements = { k = { type = "spring", between = ["a", "b"], stiffness = 1 } }
[elements]
k1 = { type = "m", between = ["a", "ground"] }
)~",
       R"~(
scene.toml:1:9: error: a model needs `ports`
    1 | [models.m]
      |         ^
  ports = ["a", "b"]
)~"},
      {"no elements",
       R"~(
[models.m]
ports = ["a"]
[elements]
k1 = { type = "m", at = "a" }
)~",
       R"~(
scene.toml:1:9: error: a model needs `elements`
    1 | [models.m]
      |         ^
  [models.m.elements] with a line for each
)~"},
      {"an empty model",
       R"~(
[models.m]
ports = ["a"]
elements = {}
[elements]
k1 = { type = "m", at = "a" }
)~",
       R"~(
scene.toml:3:1: error: model `m` has no elements
    3 | elements = {}
      | ^
)~"},
      {"bad ports",
       R"~(
[models.m]
ports = ["a", "a", "ground", 3]
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = 1 } }
[elements]
k1 = { type = "m", at = "a" }
)~",
       R"~(
scene.toml:2:15: error: port `a` is named twice
    2 | ports = ["a", "a", "ground", 3]
      |               ^
scene.toml:2:20: error: a port cannot be called `ground`
    2 | ports = ["a", "a", "ground", 3]
      |                    ^
  `ground` is known inside every model anyway
scene.toml:2:30: error: the name of a port must be a string, but is the number 3
    2 | ports = ["a", "a", "ground", 3]
      |                              ^
  ports = ["a", "b"]
)~"},
      {"a port that nothing is at",
       R"~(
[models.m]
ports = ["a", "b"]
elements = { k = { type = "spring", between = ["a", "c"], stiffness = 1 } }
[elements]
k1 = { type = "m", between = ["x", "y"] }
)~",
       R"~(
scene.toml:2:15: error: no element of model `m` is at its port `b`
    2 | ports = ["a", "b"]
      |               ^
  elements name ports as they name nodes
)~"},
      {"a mistyped key of a model",
       R"~(
[models.m]
ports = ["a"]
parameter = { k = 1 }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
k1 = { type = "m", at = "x" }
)~",
       R"~(
scene.toml:3:1: error: unknown key `parameter` of a model
    3 | parameter = { k = 1 }
      | ^
  did you mean `parameters`?
)~"},
      {"bad names of parameters",
       R"~(
[models.m]
ports = ["a"]
parameters = { type = 1, "x-y" = 3 }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = 2 } }
[elements]
k1 = { type = "m", at = "x" }
)~",
       R"~(
scene.toml:3:16: error: a parameter cannot be called `type`
    3 | parameters = { type = 1, "x-y" = 3 }
      |                ^
  an element has a key of that name already
scene.toml:3:26: error: `x-y` is no name for a parameter
    3 | parameters = { type = 1, "x-y" = 3 }
      |                          ^
  names that expressions use are made of letters, digits and `_`, and begin with no digit
)~"},
      {"a parameter without default is not given",
       R"~(
[models.m]
ports = ["a"]
parameters = ["k"]
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
k1 = { type = "m", at = "x" }
)~",
       R"~(
scene.toml:6:1: error: a `m` needs `k`
    6 | k1 = { type = "m", at = "x" }
      | ^
  the model gives it no default
)~"},
      {"parameters that are neither names nor tables, and one named twice",
       R"~(
[models.m]
ports = ["a"]
parameters = ["k", 3, { B = 1, k = 2 }]
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
k1 = { type = "m", at = "x", k = 1 }
)~",
       R"~(
scene.toml:3:20: error: the name of a parameter must be a string, but is the number 3
    3 | parameters = ["k", 3, { B = 1, k = 2 }]
      |                    ^
  ["k", "B", { n = 1 }]: names, and tables of defaults
scene.toml:3:32: error: parameter `k` is named twice
    3 | parameters = ["k", 3, { B = 1, k = 2 }]
      |                                ^
)~"},
      {"conditions on the parameters of a model, in an instance and in a repeated one",
       R"~(
[models.m]
ports = ["a"]
parameters = ["k", { limit = "3 N/m" }]
check = { soft = { that = "k < limit", error = "k must be below the limit" } }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
fine = { type = "m", at = "x", k = "2 N/m" }
hard = { type = "m", at = "x", k = "4 N/m" }
many = { type = "m", at = "x", k = "4.5 N/m", repeat = { count = 3, arrange = "parallel" } }
)~",
       R"~(
scene.toml:4:27: error: check `soft`: k must be below the limit (in `hard`)
    4 | check = { soft = { that = "k < limit", error = "k must be below the limit" } }
      |                           ^
  `k < limit` does not hold: k = 4 N/m, limit = 3 N/m
)~"},
      {"a model of one domain, and one for both with three ports",
       R"~(
[models.m]
ports = ["a", "b"]
domain = "rotation"
elements = { k = { type = "spring", between = ["a", "b"], stiffness = 1 } }
[models.n]
ports = ["a", "b", "c"]
domain = "both"
elements = { k = { type = "spring", between = ["a", "b"], stiffness = 1 }, l = { type = "spring", between = ["c", "b"], stiffness = 1 } }
[elements]
k1 = { type = "m", between = ["x", "ground"] }
)~",
       R"~(
scene.toml:3:10: error: the `domain` of a model or a law can only be `both`, but is `rotation`
    3 | domain = "rotation"
      |          ^
  its elements, or its instances, may belong to one domain
scene.toml:7:10: error: only a model with two ports can be for both domains
    7 | domain = "both"
      |          ^
)~"},
      {"a mistyped parameter of an instance",
       R"~(
[models.m]
ports = ["a"]
parameters = { stiff = 3 }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "stiff" } }
[elements]
k1 = { type = "m", at = "x", stif = 3 }
)~",
       R"~(
scene.toml:6:30: error: unknown key `stif` of a `m`
    6 | k1 = { type = "m", at = "x", stif = 3 }
      |                              ^
  did you mean `stiff`?
)~"},
      {"a parameter of another dimension than its default",
       R"~(
[models.m]
ports = ["a"]
parameters = { k = "3 N/m" }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
k1 = { type = "m", at = "x", k = "3 mm" }
)~",
       R"~(
scene.toml:6:34: error: `k` of `m`: expected a stiffness (N/m), as its default is, found a length (m)
    6 | k1 = { type = "m", at = "x", k = "3 mm" }
      |                                  ^
)~"},
      {"a mistake in a model, reported once and for an instance",
       R"~(
[models.m]
ports = ["a"]
parameters = { k = "3 N" }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
k1 = { type = "m", at = "x" }
k2 = { type = "m", at = "y" }
)~",
       R"~(
scene.toml:4:76: error: `stiffness`: expected a stiffness (N/m), found a force (N) (in `k1`)
    4 | elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
      |                                                                            ^
)~"},
      {"a node too few for the ports",
       R"~(
[models.m]
ports = ["a", "b", "c"]
elements = { k = { type = "spring", between = ["a", "b"], stiffness = 1 }, l = { type = "spring", between = ["b", "c"], stiffness = 1 } }
[elements]
k1 = { type = "m", between = ["x", "y"] }
)~",
       R"~(
scene.toml:5:30: error: `between` must name 3 nodes, but names 2
    5 | k1 = { type = "m", between = ["x", "y"] }
      |                              ^
  one for each port of the model
)~"},
      {"two nodes for one port",
       R"~(
[models.m]
ports = ["a"]
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = 1 } }
[elements]
k1 = { type = "m", between = ["x", "y"] }
)~",
       R"~(
scene.toml:5:20: error: `k1` is `at` one node, not `between` several
    5 | k1 = { type = "m", between = ["x", "y"] }
      |                    ^
  at = "a"
)~"},
      {"the number of a member is not seen inside its model",
       R"~(
[models.m]
ports = ["a"]
parameters = { k = 1 }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k*i" } }
[elements]
k1 = { type = "m", at = "x", repeat = { count = 2, arrange = "parallel" } }
)~",
       R"~(
scene.toml:4:79: error: `stiffness`: unknown name `i` (in `k1.0`)
    4 | elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k*i" } }
      |                                                                               ^
  did you mean `pi`?
)~"},
      {"defaults in a circle",
       R"~(
[models.m]
ports = ["a"]
parameters = { k = "l", l = "k" }
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = "k" } }
[elements]
k1 = { type = "m", at = "x" }
)~",
       R"~(
scene.toml:3:16: error: parameters depend on each other in a circle: `k` -> `l` -> `k`
    3 | parameters = { k = "l", l = "k" }
      |                ^
  one of them must be given by numbers
)~"},
  });
}

}  // namespace rheonet::test::bad_models_test
