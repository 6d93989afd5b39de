// Bad blocks, laws, loops, domains and conditions: what a user sees.
#include <doctest/doctest.h>

#include "tests/contract/refusals.hpp"

namespace rheonet::test::bad_laws_test {

TEST_CASE("contract: what is wrong with a block, a law or a loop is told") {
  check_refusals({
      {"a function without an output",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "function", in = ["a.velocity"] }
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
)~",
       R"~(
scene.toml:4:1: error: a `sample` needs `period`
    4 | f = { type = "sample", in = "a.velocity" }
      | ^
  a time, in s: time between two samples
)~"},
      {"a negative period",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
m2 = { type = "mass", at = "b", mass = 1 }
f = { type = "sample", in = "a.velocity", period = "-1 s" }
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
)~",
       R"~(`g2` makes a loop with `g1`, and their ratios contradict each other: the velocity of `a` is 3 times that of `b` by `g2`, and 2 times by the others, so that nothing could move; leave one of them out)~"},
      {"a gear that ties two motions together",
       R"~(
domain = "rotation"
[elements]
d1 = { type = "motion", at = "a", velocity = 1 }
d2 = { type = "motion", at = "b", velocity = 1 }
g = { type = "gear", between = ["a", "b"], ratio = 2 }
)~",
       R"~(transmission `g` joins node `b`, which motion `d2` moves at 1 rad/s, to node `a`, which motion `d1` moves at 1 rad/s, at t = 0 s; leave out the link or one of the motions)~"},
      {"a mass at a rotating node",
       R"~(
[elements]
j = { type = "inertia", at = "a", inertia = 1 }
m = { type = "mass", at = "a", mass = 1 }
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
  });
}

}  // namespace rheonet::test::bad_laws_test
