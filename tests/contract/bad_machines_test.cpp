// Bad parameters and impossible combinations of the elements of machines, of blocks and of laws in the netlist: what a user sees.
#include <doctest/doctest.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::bad_machines_test {

namespace {

struct Bad {
  const char* what;
  const char* netlist;  ///< begins with a line break
  const char* message;  ///< exactly; those of the reader begin with a line break
};

}  // namespace

TEST_CASE("contract: what is wrong with an element of a machine, a block or a law is told") {
  const Bad list[] = {
      {"a gear without a ratio",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:1: error: a `gear` needs `ratio`
    5 | g = { type = "gear", between = ["a", "b"] }
      | ^
  a number
)~"},
      {"a ratio of 0",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 0 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:52: error: `ratio` must not be 0: the first node would stand still, whatever the second does; join it to `ground` if it does
    5 | g = { type = "gear", between = ["a", "b"], ratio = 0 }
      |                                                    ^
)~"},
      {"a ratio with a unit",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = "3 m" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:52: error: `ratio`: expected a number without a unit, found a length (m)
    5 | g = { type = "gear", between = ["a", "b"], ratio = "3 m" }
      |                                                    ^
)~"},
      {"an efficiency above 1",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 2, efficiency = 1.2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:68: error: `efficiency` must be at most 1, but is 1.2
    5 | g = { type = "gear", between = ["a", "b"], ratio = 2, efficiency = 1.2 }
      |                                                                    ^
)~"},
      {"an efficiency below 0",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 2, efficiency = -0.1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:68: error: `efficiency` must be greater than 0, but is -0.1
    5 | g = { type = "gear", between = ["a", "b"], ratio = 2, efficiency = -0.1 }
      |                                                                    ^
)~"},
      {"a negative friction of a gear",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 2, friction = -1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:55: error: unknown key `friction` of a `gear`
    5 | g = { type = "gear", between = ["a", "b"], ratio = 2, friction = -1 }
      |                                                       ^
  its keys are `type`, `between`, `support`, `domain`, `ratio`, `efficiency`, `bearing` and `repeat`
)~"},
      {"gear between one node",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "a"], ratio = 2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:38: error: `between` names the node `a` twice
    5 | g = { type = "gear", between = ["a", "a"], ratio = 2 }
      |                                      ^
  an element is between different nodes
)~"},
      {"a gear between three nodes",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b", "c"], ratio = 2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:32: error: `between` must name two nodes, but names 3
    5 | g = { type = "gear", between = ["a", "b", "c"], ratio = 2 }
      |                                ^
  between = ["a", "ground"]
)~"},
      {"a gear with a stiffness",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 2, stiffness = 10 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:55: error: unknown key `stiffness` of a `gear`
    5 | g = { type = "gear", between = ["a", "b"], ratio = 2, stiffness = 10 }
      |                                                       ^
  its keys are `type`, `between`, `support`, `domain`, `ratio`, `efficiency`, `bearing` and `repeat`
)~"},
      {"a rack without a radius",
       R"~(
[nodes]
[elements]
j = { type = "inertia", at = "r", inertia = 1 }
m = { type = "mass", at = "x", mass = 1 }
p = { type = "rack", rotation = "r", translation = "x" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:1: error: `p` needs `between`
    5 | p = { type = "rack", rotation = "r", translation = "x" }
      | ^
  between = ["a", "ground"]
scene.toml:5:1: error: a `rack` needs `radius`
    5 | p = { type = "rack", rotation = "r", translation = "x" }
      | ^
  a length, in m
scene.toml:5:22: error: unknown key `rotation` of a `rack`
    5 | p = { type = "rack", rotation = "r", translation = "x" }
      |                      ^
  its keys are `type`, `between`, `radius` and `repeat`
scene.toml:5:38: error: unknown key `translation` of a `rack`
    5 | p = { type = "rack", rotation = "r", translation = "x" }
      |                                      ^
  its keys are `type`, `between`, `radius` and `repeat`
)~"},
      {"a radius of 0",
       R"~(
[elements]
j = { type = "inertia", at = "r", inertia = 1 }
m = { type = "mass", at = "x", mass = 1 }
p = { type = "rack", between = ["r", "x"], radius = "0 m" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:53: error: `radius` must be greater than 0, but is 0
    4 | p = { type = "rack", between = ["r", "x"], radius = "0 m" }
      |                                                     ^
)~"},
      {"a lead of 0",
       R"~(
[elements]
j = { type = "inertia", at = "r", inertia = 1 }
m = { type = "mass", at = "x", mass = 1 }
p = { type = "screw", between = ["r", "x"], lead = "0 mm" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:52: error: `lead` must not be 0: the nut would not move
    4 | p = { type = "screw", between = ["r", "x"], lead = "0 mm" }
      |                                                    ^
)~"},
      {"a lead that is an angle",
       R"~(
[elements]
j = { type = "inertia", at = "r", inertia = 1 }
m = { type = "mass", at = "x", mass = 1 }
p = { type = "screw", between = ["r", "x"], lead = "5 rad" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:52: error: `lead`: expected a length (m), found an angle (rad)
    4 | p = { type = "screw", between = ["r", "x"], lead = "5 rad" }
      |                                                    ^
)~"},
      {"a planetary gear between two nodes",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
p = { type = "planetary", between = ["a", "b"], ratio = 2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:37: error: `between` must name 3 nodes, but names 2
    5 | p = { type = "planetary", between = ["a", "b"], ratio = 2 }
      |                                     ^
  between = ["sun", "carrier", "ring"]
)~"},
      {"a planetary gear whose nodes have keys of their own",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
p = { type = "planetary", sun = "a", ring = "b", ratio = 2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:1: error: `p` needs `between`
    5 | p = { type = "planetary", sun = "a", ring = "b", ratio = 2 }
      | ^
  between = ["sun", "carrier", "ring"]
scene.toml:5:27: error: unknown key `sun` of a `planetary`
    5 | p = { type = "planetary", sun = "a", ring = "b", ratio = 2 }
      |                           ^
  its keys are `type`, `between`, `domain`, `ratio` and `repeat`
scene.toml:5:38: error: unknown key `ring` of a `planetary`
    5 | p = { type = "planetary", sun = "a", ring = "b", ratio = 2 }
      |                                      ^
  its keys are `type`, `between`, `domain`, `ratio` and `repeat`
)~"},
      {"a planetary ratio of 0",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
p = { type = "planetary", between = ["a", "c", "b"], ratio = 0 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:62: error: `ratio` must be greater than 0, but is 0
    5 | p = { type = "planetary", between = ["a", "c", "b"], ratio = 0 }
      |                                                              ^
)~"},
      {"a negative inertance",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
i = { type = "inerter", between = ["a", "b"], inertance = -1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:59: error: `inertance` must be at least 0, but is -1 kg
    4 | i = { type = "inerter", between = ["a", "b"], inertance = -1 }
      |                                                           ^
)~"},
      {"an inertance in kg/s",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
i = { type = "inerter", between = ["a", "b"], inertance = "1 kg/s" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:59: error: `inertance`: expected a mass (kg), found a damping (N*s/m)
    4 | i = { type = "inerter", between = ["a", "b"], inertance = "1 kg/s" }
      |                                                           ^
)~"},
      {"an inerter without an inertance",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
i = { type = "inerter", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: an `inerter` needs `inertance`
    4 | i = { type = "inerter", between = ["a", "b"] }
      | ^
  a mass, in kg
)~"},
      {"a stop whose bounds are the wrong way round",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = 1, upper = -1, stiffness = 1e4 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:63: error: `upper` is less than `lower`
    4 | s = { type = "stop", between = ["a", "b"], lower = 1, upper = -1, stiffness = 1e4 }
      |                                                               ^
)~"},
      {"a stop without bounds",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], stiffness = 1e4 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: `lower` and `upper` are both missing: give one of them, or both
    4 | s = { type = "stop", between = ["a", "b"], stiffness = 1e4 }
      | ^
)~"},
      {"a stop with a negative stiffness",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = -5 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:68: error: `stiffness` must be at least 0, but is -5 N/m
    4 | s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = -5 }
      |                                                                    ^
)~"},
      {"an elastic stop with a restitution",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = 1e4, restitution = 0.5 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:87: error: `restitution` is that of a rigid stop, with `stiffness = "inf"`: an elastic one has a `damping`
    4 | s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = 1e4, restitution = 0.5 }
      |                                                                                       ^
)~"},
      {"a rigid stop with a damping",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = "inf", damping = 3 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:85: error: `damping` is that of an elastic stop: a rigid one, with `stiffness = "inf"`, has a `restitution`
    4 | s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = "inf", damping = 3 }
      |                                                                                     ^
)~"},
      {"a restitution above 1",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = "inf", restitution = 1.5 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:89: error: `restitution` must be at most 1, but is 1.5
    4 | s = { type = "stop", between = ["a", "b"], lower = -1, stiffness = "inf", restitution = 1.5 }
      |                                                                                         ^
)~"},
      {"a bound with the unit of a force",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = "-1 N", stiffness = 1e4 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:52: error: `lower`: expected a length (m), found a force (N)
    4 | s = { type = "stop", between = ["a", "b"], lower = "-1 N", stiffness = 1e4 }
      |                                                    ^
)~"},
      {"a start beyond a rigid stop",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
s = { type = "stop", between = ["a", "ground"], upper = 0.1, stiffness = "inf" }
[nodes]
a = { position = 0.2 }
[simulate]
stop = 1
)~",
       R"~(element `s` cannot start with the displacement 0.2 m: it is rigid at its bound, 0.1 m; change the start position of node `a`, or the bound)~"},
      {"a damped stop at a node without mass",
       R"~(
[elements]
k = { type = "spring", between = ["a", "ground"], stiffness = 1 }
f = { type = "force", at = "a", force = 1 }
s = { type = "stop", between = ["a", "ground"], upper = 0.1, stiffness = 10, damping = 1 }
[simulate]
stop = 1
)~",
       R"~(the force of `s` depends, by its damping, on the velocity, and node `a` has no mass: no balance of forces determines its velocity; give it a mass)~"},
      {"a freewheel with a coulomb",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
w = { type = "freewheel", between = ["a", "b"], coulomb = 1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:49: error: unknown key `coulomb` of a `freewheel`
    5 | w = { type = "freewheel", between = ["a", "b"], coulomb = 1 }
      |                                                 ^
  its keys are `type`, `between`, `domain` and `repeat`
)~"},
      {"a freewheel with a ratio",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
w = { type = "freewheel", between = ["a", "b"], ratio = 1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:49: error: unknown key `ratio` of a `freewheel`
    5 | w = { type = "freewheel", between = ["a", "b"], ratio = 1 }
      |                                                 ^
  its keys are `type`, `between`, `domain` and `repeat`
)~"},
      {"stribeck as a table",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], stribeck = { breakaway = 2, velocity = 0.1 } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `slider` needs `coulomb`
    4 | s = { type = "slider", between = ["a", "b"], stribeck = { breakaway = 2, velocity = 0.1 } }
      | ^
  a force, in N
scene.toml:4:57: error: `stribeck` is constant in time, but is a table
    4 | s = { type = "slider", between = ["a", "b"], stribeck = { breakaway = 2, velocity = 0.1 } }
      |                                                         ^
  what may vary in time is `coulomb`, `breakaway` and `normal` of a `slider`
)~"},
      {"a normal force without a coefficient",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], normal = 5 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `slider` needs `coulomb`
    4 | s = { type = "slider", between = ["a", "b"], normal = 5 }
      | ^
  a number without a unit, which multiplies `normal`
)~"},
      {"a coefficient with the unit of a force beside normal",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], coulomb = "2 N", normal = "5 N" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:56: error: `coulomb` (which multiplies `normal`): expected a number without a unit, found a force (N)
    4 | s = { type = "slider", between = ["a", "b"], coulomb = "2 N", normal = "5 N" }
      |                                                        ^
)~"},
      {"a breakaway below coulomb",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], coulomb = 2, breakaway = 1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:71: error: `breakaway` must be at least `coulomb`: under a force between the two the slider could neither stick nor slip
    4 | s = { type = "slider", between = ["a", "b"], coulomb = 2, breakaway = 1 }
      |                                                                       ^
)~"},
      {"stribeck as a table beside the friction",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], coulomb = 2, breakaway = 3, stribeck = { speed = 0.1 } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:85: error: `stribeck` is constant in time, but is a table
    4 | s = { type = "slider", between = ["a", "b"], coulomb = 2, breakaway = 3, stribeck = { speed = 0.1 } }
      |                                                                                     ^
  what may vary in time is `coulomb`, `breakaway` and `normal` of a `slider`
)~"},
      {"a stribeck velocity of 0",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], coulomb = 2, breakaway = 3, stribeck = 0 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:85: error: `stribeck` must be greater than 0, but is 0
    4 | s = { type = "slider", between = ["a", "b"], coulomb = 2, breakaway = 3, stribeck = 0 }
      |                                                                                     ^
)~"},
      {"a negative coulomb",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "slider", between = ["a", "b"], coulomb = -2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:56: error: `coulomb` must be at least 0, but is -2 N
    4 | s = { type = "slider", between = ["a", "b"], coulomb = -2 }
      |                                                        ^
)~"},
      {"a characteristic that is not increasing",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
k = { type = "spring", between = ["a", "b"], force = { table = [[0, 0], [0, 1]] } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:74: error: `force` must have points of increasing displacement, but 0 follows 0
    4 | k = { type = "spring", between = ["a", "b"], force = { table = [[0, 0], [0, 1]] } }
      |                                                                          ^
)~"},
      {"a characteristic with one point",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
k = { type = "spring", between = ["a", "b"], force = { table = [[0, 0]] } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:66: error: `force` needs at least two points
    4 | k = { type = "spring", between = ["a", "b"], force = { table = [[0, 0]] } }
      |                                                                  ^
  force = [[0, 0], [0.01, 5], [0.02, 20]]
)~"},
      {"a stiffness and a characteristic",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
k = { type = "spring", between = ["a", "b"], stiffness = 1, force = { table = [[0, 0], [1, 1]] } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:61: error: a `spring` has both `stiffness` and `force`
    4 | k = { type = "spring", between = ["a", "b"], stiffness = 1, force = { table = [[0, 0], [1, 1]] } }
      |                                                             ^
  only one of them can be given
)~"},
      {"a characteristic under another key",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
k = { type = "dashpot", between = ["a", "b"], force = { expression = "3*d" } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:55: error: `force` needs `table`
    4 | k = { type = "dashpot", between = ["a", "b"], force = { expression = "3*d" } }
      |                                                       ^
  force = { table = [[0, 0], [0.01, 5], [0.02, 20]] }
scene.toml:4:57: error: unknown key `expression` of `force`
    4 | k = { type = "dashpot", between = ["a", "b"], force = { expression = "3*d" } }
      |                                                         ^
  its keys are `table`, `columns` and `smooth`
)~"},
      {"a motion by velocity and acceleration",
       R"~(
[elements]
d = { type = "motion", at = "a", velocity = 1, acceleration = 2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:2:48: error: a `motion` has both `velocity` and `acceleration`
    2 | d = { type = "motion", at = "a", velocity = 1, acceleration = 2 }
      |                                                ^
  only one of them can be given
)~"},
      {"an acceleration in m/s",
       R"~(
[elements]
d = { type = "motion", at = "a", acceleration = "2 m/s" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:2:49: error: `acceleration`: expected an acceleration (m/s^2), found a velocity (m/s)
    2 | d = { type = "motion", at = "a", acceleration = "2 m/s" }
      |                                                 ^
)~"},
      {"a function without an output",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "function", in = ["a.velocity"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `function` needs `out`
    4 | f = { type = "function", in = ["a.velocity"] }
      | ^
  an expression over the inputs and the time: "u1*u2"
)~"},
      {"a function whose output has another key",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "function", in = ["a.velocity"], expression = "u2" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `function` needs `out`
    4 | f = { type = "function", in = ["a.velocity"], expression = "u2" }
      | ^
  an expression over the inputs and the time: "u1*u2"
scene.toml:4:47: error: unknown key `expression` of a `function`
    4 | f = { type = "function", in = ["a.velocity"], expression = "u2" }
      |                                               ^
  its keys are `type`, `in`, `out` and `repeat`
)~"},
      {"a lookup without points",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "lookup", in = "a.velocity" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `lookup` needs `table`
    4 | f = { type = "lookup", in = "a.velocity" }
      | ^
  points [input, output], or the name of a CSV file: table = [["0 m", "0 N"], ["1 m", "5 N"]]
)~"},
      {"points of a lookup that go back",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "lookup", in = "a.velocity", table = [[1, 0], [0, 1]] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:61: error: the inputs of a table must not decrease, but 0 follows 1
    4 | f = { type = "lookup", in = "a.velocity", table = [[1, 0], [0, 1]] }
      |                                                             ^
)~"},
      {"a sample without a period",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "sample", in = "a.velocity" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `sample` needs `period`
    4 | f = { type = "sample", in = "a.velocity" }
      | ^
  a time, in s
)~"},
      {"a negative period",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "sample", in = "a.velocity", period = "-1 s" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:52: error: `period` must be greater than 0, but is -1 s
    4 | f = { type = "sample", in = "a.velocity", period = "-1 s" }
      |                                                    ^
)~"},
      {"a transfer function with more zeros than poles",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "transfer", in = "a.velocity", numerator = [1, 2, 3], denominator = [1, 1] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:57: error: `numerator` has a higher degree than `denominator`: the transfer function would differentiate its input
    4 | f = { type = "transfer", in = "a.velocity", numerator = [1, 2, 3], denominator = [1, 1] }
      |                                                         ^
)~"},
      {"a transfer function without a denominator",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "transfer", in = "a.velocity", numerator = [1] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:1: error: a `transfer` needs `denominator`
    4 | f = { type = "transfer", in = "a.velocity", numerator = [1] }
      | ^
  coefficients of the powers of s, the highest first: ["0.1 s", 1] is 0.1 s + 1
)~"},
      {"a denominator of zeros",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "transfer", in = "a.velocity", numerator = [1], denominator = [0, 0] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:76: error: `denominator` begins with 0: its first coefficient, that of the highest power of s, must not be 0
    4 | f = { type = "transfer", in = "a.velocity", numerator = [1], denominator = [0, 0] }
      |                                                                            ^
)~"},
      {"an input that is no record",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "gain", in = "a.speed", gain = 2 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:30: error: `a` has no `speed`
    4 | f = { type = "gain", in = "a.speed", gain = 2 }
      |                              ^
  did you mean `a.velocity`?
)~"},
      {"interpolation under another key",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "force", at = "a", force = { table = [[0, 0], [1, 1]], interpolation = "cubic" } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:69: error: unknown key `interpolation` of a `table` signal
    4 | f = { type = "force", at = "a", force = { table = [[0, 0], [1, 1]], interpolation = "cubic" } }
      |                                                                     ^
  its keys are `table`, `amplitude`, `time`, `offset`, `columns` and `smooth`
)~"},
      {"a law without a force",
       R"~(
[laws.x]
parameters = { c = "1 N" }
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "x", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:1:7: error: a law needs `force`
    1 | [laws.x]
      |       ^
  force = "k*d + c*w", an expression over the displacement d and the velocity w
)~"},
      {"a law whose force is a velocity",
       R"~(
[laws.x]
parameters = { c = "1 m/s" }
force = "c"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "x", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:3:9: error: `force` of law `x`: expected a force (N), found a velocity (m/s) (in `e`)
    3 | force = "c"
      |         ^
)~"},
      {"a law with an unknown name",
       R"~(
[laws.x]
parameters = { c = "1 N" }
force = "c*tanh(w/v0)"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "x", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:3:19: error: `force` of law `x`: unknown name `v0`
    3 | force = "c*tanh(w/v0)"
      |                   ^
  known here are `d`, `w`, `t` and `c`
)~"},
      {"a law that is an element already",
       R"~(
[laws.spring]
parameters = { c = "1 N" }
force = "c"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "spring", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:1:7: error: `spring` is an element type already
    1 | [laws.spring]
      |       ^
  a law needs a name of its own
scene.toml:7:1: error: a `spring` needs `stiffness` or `force`
    7 | e = { type = "spring", between = ["a", "b"] }
      | ^
)~"},
      {"a state without a rate",
       R"~(
[laws.x]
parameters = { c = "1 N" }
states = { z = "0 m" }
force = "c*z/(1 m)"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "x", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:3:16: error: state `z` must be a table, but is the string "0 m"
    3 | states = { z = "0 m" }
      |                ^
  states = { z = { start = "0 m", rate = "w - ..." } }
scene.toml:4:17: error: `force` of law `x`: there is no parameter `m`, and a unit cannot stand in an expression
    4 | force = "c*z/(1 m)"
      |                 ^
  known here are `d`, `w`, `t`, `c`, `z` and `rate(z)`
)~"},
      {"a sum of a force and a length in a law",
       R"~(
[laws.x]
parameters = { c = "1 N" }
force = "c + d"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "x", between = ["a", "b"] }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:3:14: error: `force` of law `x`: `c` is a force (N), `d` is a length (m): they cannot be added (in `e`)
    3 | force = "c + d"
      |              ^
)~"},
      {"a check that fails",
       R"~(
[laws.x]
parameters = { c = "1 N" }
force = "c*sgn(w)"
[laws.x.check]
positive = { that = "c > 0", error = "c must be above 0" }
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
e = { type = "x", between = ["a", "b"], c = "-1 N" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:5:21: error: check `positive`: c must be above 0 (in `e`)
    5 | positive = { that = "c > 0", error = "c must be above 0" }
      |                     ^
  `c > 0` does not hold: c = -1 N
)~"},
      {"two gears around a loop that disagree",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g1 = { type = "gear", between = ["a", "b"], ratio = 2 }
g2 = { type = "gear", between = ["a", "b"], ratio = 3 }
t = { type = "torque", at = "a", torque = 1 }
[simulate]
stop = 1
)~",
       R"~(`g2` makes a loop with `g1`, and their ratios contradict each other: the velocity of `a` is 3 times that of `b` by `g2`, and 2 times by the others, so that nothing could move; leave one of them out)~"},
      {"a gear that ties two motions together",
       R"~(
domain = "rotation"
[elements]
d1 = { type = "motion", at = "a", velocity = 1 }
d2 = { type = "motion", at = "b", velocity = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 2 }
[simulate]
stop = 1
)~",
       R"~(transmission `g` joins node `b`, which motion `d2` moves at 1 rad/s, to node `a`, which motion `d1` moves at 1 rad/s, at t = 0 s; leave out the link or one of the motions)~"},
      {"a mass at a rotating node",
       R"~(
[elements]
j = { type = "inertia", at = "a", inertia = 1 }
m = { type = "mass", at = "a", mass = 1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:3:32: error: `mass` is called `inertia` in rotation, and `m` is of rotation, by `j`
    3 | m = { type = "mass", at = "a", mass = 1 }
      |                                ^
  write `inertia`; if `m` is to be of translation, only a `rack` or a `screw` joins it to the other
)~"},
      {"a spring between a rotating and a moving node",
       R"~(
[elements]
j = { type = "inertia", at = "a", inertia = 1 }
m = { type = "mass", at = "b", mass = "1 kg" }
k = { type = "spring", between = ["a", "b"], stiffness = "1 N/m" }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:3:32: error: `mass` is called `inertia` in rotation, and `m` is of rotation, by `j` through `k`
    3 | m = { type = "mass", at = "b", mass = "1 kg" }
      |                                ^
  write `inertia`; if `m` is to be of translation, only a `rack` or a `screw` joins it to the other
scene.toml:4:58: error: `stiffness`: expected a torsional stiffness (N*m/rad), found a stiffness (N/m)
    4 | k = { type = "spring", between = ["a", "b"], stiffness = "1 N/m" }
      |                                                          ^
  this is of rotation, by `domain` or by another element at its nodes
)~"},
      {"stop_when with a number",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
[simulate]
stop = 1
stop_when = 3
)~",
       R"~(
scene.toml:6:13: error: `stop_when` must be a string, but is the number 3
    6 | stop_when = 3
      |             ^
  stop_when = "a.position > xmax"
)~"},
      {"stop_when of a name that is not there",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
[simulate]
stop = 1
stop_when = "c.position > 1 m"
)~",
       R"~(
scene.toml:6:14: error: nothing is called `c`
    6 | stop_when = "c.position > 1 m"
      |              ^
)~"},
      {"a record of an expression under another key",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
[simulate]
stop = 1
record = [{ name = "s", expression = "a.position + a.velocity" }]
)~",
       R"~(
scene.toml:6:11: error: an expression of `record` needs `value`
    6 | record = [{ name = "s", expression = "a.position + a.velocity" }]
      |           ^
  { name = "gap", value = "a.position - b.position" }
scene.toml:6:25: error: unknown key `expression` of an expression of `record`
    6 | record = [{ name = "s", expression = "a.position + a.velocity" }]
      |                         ^
  its keys are `name` and `value`
)~"},
      {"a record of the energy of a node",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
[simulate]
stop = 1
record = ["a.energy"]
)~",
       R"~(
scene.toml:6:14: error: `a` has no `energy`
    6 | record = ["a.energy"]
      |              ^
  it has `position`, `velocity` and `acceleration`
)~"},
      {"noise without a seed, and with a wrong key",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "force", at = "a", force = { noise = 1, bandwith = "10 Hz" } }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:4:43: error: a `noise` signal needs `interval`
    4 | f = { type = "force", at = "a", force = { noise = 1, bandwith = "10 Hz" } }
      |                                           ^
  the time for which each value holds
scene.toml:4:43: error: a `noise` signal needs `seed`
    4 | f = { type = "force", at = "a", force = { noise = 1, bandwith = "10 Hz" } }
      |                                           ^
  a whole number: signals of one seed have the same values
scene.toml:4:54: error: unknown key `bandwith` of a `noise` signal
    4 | f = { type = "force", at = "a", force = { noise = 1, bandwith = "10 Hz" } }
      |                                                      ^
  its keys are `noise`, `interval`, `seed`, `amplitude`, `time` and `offset`
)~"},
  };
  for (const Bad& bad : list) {
    CAPTURE(std::string(bad.what));
    const std::string message = bad.message, told = refusal(bad.netlist + 1);
    CHECK(told == (message.starts_with('\n') ? message.substr(1) : message));
  }
}

}  // namespace rheonet::test::bad_machines_test
