#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_simulate_test {

TEST_CASE("bad netlists: the tables of a scene, records and initial values") {
  check_all({
      {"a mistyped table",
       R"~(
[element]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:1:2: error: unknown key `element` of the scene
    1 | [element]
      |  ^
  did you mean `elements`?
)~"},
      {"an unknown key of [simulate]",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
duration = 3
)~",
       R"~(
scene.toml:5:1: error: unknown key `duration` of [simulate]
    5 | duration = 3
      | ^
  its keys are `start`, `start_from`, `method`, `stop`, `stop_when`, `accuracy`, `output` and `record`
)~"},
      {"a key of [simulate] among the tables",
       R"~(
accuracy = 1e-3
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
)~",
       R"~(
scene.toml:1:1: error: unknown key `accuracy` of the scene
    1 | accuracy = 1e-3
      | ^
  `accuracy` belongs in [simulate]
)~"},
      {"a mistyped start",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
start_from = "stedy"
stop = 1
)~",
       R"~(
scene.toml:4:14: error: `start_from` must be `given`, `rest` or `steady`, but is `stedy`
    4 | start_from = "stedy"
      |              ^
  did you mean `steady`?
)~"},
      {"a mistyped domain",
       R"~(
domain = "rotational"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
)~",
       R"~(
scene.toml:1:10: error: `domain` must be `translation` or `rotation`, but is `rotational`
    1 | domain = "rotational"
      |          ^
  did you mean `rotation`?
)~"},
      {"a title that is no text",
       R"~(
title = 3
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
)~",
       R"~(
scene.toml:1:9: error: `title` must be a string, but is the number 3
    1 | title = 3
      |         ^
)~"},
      {"no elements",
       R"~(
[simulate]
stop = 1
)~",
       R"~(
scene.toml:1:1: error: the scene needs `elements`
    1 | [simulate]
      | ^
  [elements] with a line for each: k1 = { type = "spring", between = ["a", "ground"], ... }
)~"},
      {"empty elements",
       R"~(
[elements]
[simulate]
stop = 1
)~",
       R"~(
scene.toml:1:2: error: the scene has no elements
    1 | [elements]
      |  ^
)~"},
      {"no stop",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
start = 0
)~",
       R"~(
scene.toml:3:2: error: [simulate] needs `stop`
    3 | [simulate]
      |  ^
  when the run ends: stop = "1 s"
)~"},
      {"a stop before the start",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
start = 2
stop = "1 s"
)~",
       R"~(
scene.toml:5:8: error: `stop` must be later than `start`, 2 s, but is 1 s
    5 | stop = "1 s"
      |        ^
)~"},
      {"an accuracy out of bounds",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
accuracy = 1
)~",
       R"~(
scene.toml:5:12: error: `accuracy` must be from 1e-12 to 0.1, but is 1
    5 | accuracy = 1
      |            ^
)~"},
      {"one point",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = { points = 1 }
)~",
       R"~(
scene.toml:5:21: error: `points` must be a whole number of at least 2, but is 1
    5 | output = { points = 1 }
      |                     ^
)~"},
      {"two ways to say the output times",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = { every = "1 ms", points = 11 }
)~",
       R"~(
scene.toml:5:28: error: `output` has both `every` and `points`
    5 | output = { every = "1 ms", points = 11 }
      |                            ^
  only one of them can be given
)~"},
      {"an interval longer than the run",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = { every = "10 s" }
)~",
       R"~(
scene.toml:5:20: error: `every` is longer than the run: 10 s, the run takes 1 s
    5 | output = { every = "10 s" }
      |                    ^
)~"},
      {"more rows than a disk holds",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = { every = "1 ns" }
)~",
       R"~(
scene.toml:5:20: error: `output` asks for 1000000000 rows; at most 100000000 are written
    5 | output = { every = "1 ns" }
      |                    ^
)~"},
      {"an interval of 0",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = { every = 0 }
)~",
       R"~(
scene.toml:5:20: error: `every` must be greater than 0 s, but is 0 s
    5 | output = { every = 0 }
      |                    ^
)~"},
      {"output without a key",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = 0.1
)~",
       R"~(
scene.toml:5:10: error: `output` must be a table, but is the number 0.1
    5 | output = 0.1
      |          ^
  output = { every = "1 ms" } or { points = 201 }
)~"},
      {"events that are no boolean",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
output = { events = 1 }
)~",
       R"~(
scene.toml:5:21: error: `events` must be true or false, but is the number 1
    5 | output = { events = 1 }
      |                     ^
)~"},
      {"a member of a group without the name of the group",
       R"~(
[elements.strut]
between = ["body", "ground"]
parallel = [{ name = "coil", type = "spring", stiffness = 3 }, { name = "seal", type = "slider", coulomb = 2 }]
[simulate]
stop = 1
record = ["seal.force"]
)~",
       R"~(
scene.toml:6:11: error: nothing is called `seal`
    6 | record = ["seal.force"]
      |           ^
  did you mean `strut.seal.force`?
)~"},
      {"records of all kinds of nothing",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
)~",
       R"~(
scene.toml:5:11: error: nothing is called `k2`
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |           ^
  did you mean `k1.force`?
scene.toml:5:27: error: `k1` has no `torque`
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                           ^
  did you mean `k1.force`?
scene.toml:5:39: error: `a` has no `force`: it is a node, only elements have one
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                                       ^
  it has `position`, `velocity` and `acceleration`
scene.toml:5:47: error: `k1` does not say which quantity is meant
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                                               ^
  for instance `k1.force` of an element, `k1.velocity` of a node
scene.toml:5:57: error: `k1` has no `speed`
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                                                         ^
  did you mean `k1.velocity`?
scene.toml:5:65: error: `ground` never moves: there is nothing to record of it
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                                                                 ^
scene.toml:5:87: error: `a` has no `velocty`
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                                                                                       ^
  did you mean `a.velocity`?
scene.toml:5:97: error: what to record must be a string, but is the number 3
    5 | record = ["k2.force", "k1.torque", "a.force", "k1", "k1.speed", "ground.velocity", "a.velocty", 3]
      |                                                                                                 ^
  record = ["k1.force", "mid.velocity"]
)~"},
      {"one record without brackets",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
record = "k1.force"
)~",
       R"~(
scene.toml:5:10: error: `record` must be an array, but is the string "k1.force"
    5 | record = "k1.force"
      |          ^
  record = ["k1.force", "mid.velocity"]
)~"},
      {"the position of an element",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
[simulate]
stop = 1
record = ["m1.position", "m1.displacement", "m1.velocity"]
)~",
       R"~(
scene.toml:5:15: error: `m1` has no `position`: it is an element, only nodes have one
    5 | record = ["m1.position", "m1.displacement", "m1.velocity"]
      |               ^
  that of its node is `a.position`
)~"},
      {"initial values of all kinds of nothing",
       R"~(
[elements]
m1 = { type = "mass", at = "drum", mass = 1 }
[nodes]
drumm = { position = 1 }
ground = { position = 0 }
m1 = { velocity = 1 }
drum = { positon = 1, velocity = "3 mm" }
)~",
       R"~(
scene.toml:4:1: error: no element names a node `drumm`
    4 | drumm = { position = 1 }
      | ^
  did you mean `drum`?
scene.toml:5:1: error: `ground` never moves: it has no initial values
    5 | ground = { position = 0 }
      | ^
scene.toml:6:1: error: no element names a node `m1`
    6 | m1 = { velocity = 1 }
      | ^
  `m1` is an element: initial values are those of its nodes
scene.toml:7:10: error: unknown key `positon` of a node
    7 | drum = { positon = 1, velocity = "3 mm" }
      |          ^
  did you mean `position`?
scene.toml:7:34: error: `velocity`: expected a velocity (m/s), found a length (m)
    7 | drum = { positon = 1, velocity = "3 mm" }
      |                                  ^
)~"},
      {"an initial value without a key",
       R"~(
[elements]
m1 = { type = "mass", at = "drum", mass = 1 }
[nodes]
drum = 3
)~",
       R"~(
scene.toml:4:8: error: node `drum` must be a table, but is the number 3
    4 | drum = 3
      |        ^
  drum = { position = "1 m" }
)~"},
      {"the time as a record",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = 1
record = ["time"]
)~",
       R"~(
scene.toml:5:11: error: `time` is no quantity of an element or a node: it is the first column always
    5 | record = ["time"]
      |           ^
  leave it out
)~"},
  });
}

}  // namespace rheonet::test::bad_simulate_test
