// Bad gears, levers, racks, screws, planetary gears and inerters: what a user sees.
#include <doctest/doctest.h>

#include "tests/contract/refusals.hpp"

namespace rheonet::test::bad_transmissions_test {

TEST_CASE("contract: what is wrong with a transmission or an inerter is told") {
  check_refusals({
      {"a gear without a ratio",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"] }
)~",
       R"~(
scene.toml:5:1: error: a `gear` needs `ratio`
    5 | g = { type = "gear", between = ["a", "b"] }
      | ^
  a number: velocity of the first node over that of the second, not 0; negative where they turn against each other
)~"},
      {"a ratio of 0",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 0 }
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
)~",
       R"~(
scene.toml:5:1: error: `p` needs `between`
    5 | p = { type = "rack", rotation = "r", translation = "x" }
      | ^
  between = ["a", "ground"]
scene.toml:5:1: error: a `rack` needs `radius`
    5 | p = { type = "rack", rotation = "r", translation = "x" }
      | ^
  a length, in m: radius of the pinion, the drum or the wheel
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
)~",
       R"~(
scene.toml:4:1: error: an `inerter` needs `inertance`
    4 | i = { type = "inerter", between = ["a", "b"] }
      | ^
  a mass, in kg: force per relative acceleration; 0 means no inerter, inf a rigid link
)~"},
  });
}

}  // namespace rheonet::test::bad_transmissions_test
