// Bad stops, freewheels, sliders, characteristics and motions: what a user sees.
#include <doctest/doctest.h>

#include "tests/contract/refusals.hpp"

namespace rheonet::test::bad_contacts_test {

TEST_CASE("contract: what is wrong with a contact, friction or a motion is told") {
  check_refusals({
      {"a stop whose bounds are the wrong way round",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
s = { type = "stop", between = ["a", "b"], lower = 1, upper = -1, stiffness = 1e4 }
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
)~",
       R"~(element `s` cannot start with the displacement 0.2 m: it is rigid at its bound, 0.1 m; change the start position of node `a`, or the bound)~"},
      {"a damped stop at a node without mass",
       R"~(
[elements]
k = { type = "spring", between = ["a", "ground"], stiffness = 1 }
f = { type = "force", at = "a", force = 1 }
s = { type = "stop", between = ["a", "ground"], upper = 0.1, stiffness = 10, damping = 1 }
)~",
       R"~(the force of `s` depends, by its damping, on the velocity, and node `a` has no mass: no balance of forces determines its velocity; give it a mass)~"},
      {"a freewheel with a coulomb",
       R"~(
domain = "rotation"
[elements]
j1 = { type = "inertia", at = "a", inertia = 1 }
j2 = { type = "inertia", at = "b", inertia = 1 }
w = { type = "freewheel", between = ["a", "b"], coulomb = 1 }
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
)~",
       R"~(
scene.toml:4:1: error: a `slider` needs `coulomb`
    4 | s = { type = "slider", between = ["a", "b"], stribeck = { breakaway = 2, velocity = 0.1 } }
      | ^
  a force, in N: force of sliding; 0 means no force, inf a rigid link; with `normal`, the coefficient of friction
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
)~",
       R"~(
scene.toml:2:49: error: `acceleration`: expected an acceleration (m/s^2), found a velocity (m/s)
    2 | d = { type = "motion", at = "a", acceleration = "2 m/s" }
      |                                                 ^
)~"},
  });
}

}  // namespace rheonet::test::bad_contacts_test
