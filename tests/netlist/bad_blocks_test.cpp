#include <doctest/doctest.h>

#include "core/network/component.hpp"
#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_blocks_test {

namespace {

struct Bad { const char *elements, *messages; };

/// With the declarations of the project: the fake ones know no blocks.
void check_messages(const Bad& bad) {
  const std::string text = std::string("domain = \"rotation\"\n[elements]\nj = { type = \"inertia\", at = \"shaft\", inertia = 1 }\n") +
                           bad.elements + "[simulate]\nstop = 1\n";
  const ReadResult result = read_scene_text(text, "scene.toml", "no-such-folder", declarations(), {});
  CHECK_EQ('\n' + messages(result), std::string(bad.messages));
  CHECK_FALSE(result.scene);
}

}  // namespace

TEST_CASE("bad netlists: blocks and their inputs") {
  const Bad cases[] = {
      {R"~(h = { type = "generator", signal = { step = "7 rad/s" }, in = "g" }
)~",
       R"~(
scene.toml:4:58: error: unknown key `in` of a `generator`
    4 | h = { type = "generator", signal = { step = "7 rad/s" }, in = "g" }
      |                                                          ^
  its keys are `type`, `signal` and `repeat`
)~"},
      {R"~(a = { type = "gain", in = ["j.force", "shaft.velocity"], gain = 2 }
b = { type = "gain", in = "a", gain = 2 }
)~",
       R"~(
scene.toml:4:27: error: `a` takes in 1 signal, but `in` names 2
    4 | a = { type = "gain", in = ["j.force", "shaft.velocity"], gain = 2 }
      |                           ^
  a `sum` adds several
)~"},
      {R"~(b = { type = "gain", in = "nowhere", gain = 2 }
)~",
       R"~(
scene.toml:4:27: error: no block is called `nowhere`
    4 | b = { type = "gain", in = "nowhere", gain = 2 }
      |                           ^
  an input is a block (`controller`) or a quantity of the network (`drum.velocity`)
)~"},
      {R"~(c = { type = "gain", gain = 2 }
)~",
       R"~(
scene.toml:4:1: error: a `gain` needs `in`
    4 | c = { type = "gain", gain = 2 }
      | ^
  an input is a block (`controller`) or a quantity of the network (`drum.velocity`)
)~"},
      {R"~(d = { type = "gain", in = "shaft", gain = 2 }
)~",
       R"~(
scene.toml:4:27: error: `shaft` does not say which quantity is meant
    4 | d = { type = "gain", in = "shaft", gain = 2 }
      |                           ^
  for instance `shaft.velocity`
)~"},
      {R"~(e = { type = "sum", in = "shaft.velocity" }
)~",
       R"~(
scene.toml:4:26: error: `e` takes in at least 2 signals, but `in` names 1
    4 | e = { type = "sum", in = "shaft.velocity" }
      |                          ^
  in = ["a", "-b"]
)~"},
      {R"~(q = { type = "gain", in = "shaft.speed", gain = 2 }
)~",
       R"~(
scene.toml:4:34: error: `shaft` has no `speed`
    4 | q = { type = "gain", in = "shaft.speed", gain = 2 }
      |                                  ^
  did you mean `shaft.velocity`?
)~"},
      {R"~(q2 = { type = "gain", in = "nowhere.velocity", gain = 2 }
)~",
       R"~(
scene.toml:4:28: error: nothing is called `nowhere`
    4 | q2 = { type = "gain", in = "nowhere.velocity", gain = 2 }
      |                            ^
)~"},
      {R"~(r = { type = "gain", in = 3, gain = 2 }
)~",
       R"~(
scene.toml:4:27: error: `in` must be a string, but is the number 3
    4 | r = { type = "gain", in = 3, gain = 2 }
      |                           ^
  a block (`controller`) or a quantity of the network (`drum.velocity`)
)~"},
      {R"~(r2 = { type = "gain", in = "-", gain = 2 }
)~",
       R"~(
scene.toml:4:28: error: `in` is empty
    4 | r2 = { type = "gain", in = "-", gain = 2 }
      |                            ^
  a block (`controller`) or a quantity of the network (`drum.velocity`)
)~"},
      {R"~(p = { type = "gain", at = "shaft", in = "shaft.velocity", gain = 2 }
)~",
       R"~(
scene.toml:4:22: error: unknown key `at` of a `gain`
    4 | p = { type = "gain", at = "shaft", in = "shaft.velocity", gain = 2 }
      |                      ^
  its keys are `type`, `in`, `gain` and `repeat`
)~"},
      {R"~(s = { between = ["shaft", "ground"], series = [ { type = "gain", in = "j.force", gain = 1 } ] }
)~",
       R"~(
scene.toml:4:58: error: a `gain` is a block, which stands at no node: it cannot be a member of `series` or `parallel`
    4 | s = { between = ["shaft", "ground"], series = [ { type = "gain", in = "j.force", gain = 1 } ] }
      |                                                          ^
  give it an entry of its own in [elements]
)~"},
      {R"~(ctrl = { type = "gain", in = "shaft.velocity", gain = 1 }
n = { type = "torque", at = "shaft", torque = { block = "ctl" } }
)~",
       R"~(
scene.toml:5:57: error: no block is called `ctl`
    5 | n = { type = "torque", at = "shaft", torque = { block = "ctl" } }
      |                                                         ^
  did you mean `ctrl`?
)~"},
      {R"~(n = { type = "torque", at = "shaft", torque = { block = "shaft.velocity" } }
)~",
       R"~(
scene.toml:4:57: error: no block is called `shaft.velocity`
    4 | n = { type = "torque", at = "shaft", torque = { block = "shaft.velocity" } }
      |                                                         ^
  a signal comes from a block: a `gain` makes one of a quantity of the network
)~"},
      {R"~(g = { type = "gain", in = "shaft.velocity", gain = 1 }
n = { type = "torque", at = "shaft", torque = { block = "g", time = 3 } }
)~",
       R"~(
scene.toml:5:62: error: unknown key `time` of a signal from a block
    5 | n = { type = "torque", at = "shaft", torque = { block = "g", time = 3 } }
      |                                                              ^
  its keys are `block`
)~"},
      {R"~(g = { type = "gain", in = "shaft.velocity", gain = 1 }
m = { type = "generator", signal = { block = "g" } }
)~",
       R"~(
scene.toml:5:38: error: the signal of a `generator` is a function of time alone: no block can give it
    5 | m = { type = "generator", signal = { block = "g" } }
      |                                      ^
  take in that block in its place
)~"},
      {R"~(g = { type = "lag", in = "shaft.velocity", time_constant = 1, gain = "2 N*m*s/rad" }
m = { type = "motion", at = "other", position = { block = "g" } }
)~",
       R"~(
scene.toml:5:59: error: `position` from block `g`: expected an angle (rad), found a torque or an energy (N*m)
    5 | m = { type = "motion", at = "other", position = { block = "g" } }
      |                                                           ^
)~"},
      {R"~(t = { type = "lag", in = "shaft.velocity", time_constant = "0 s" }
)~",
       R"~(
scene.toml:4:60: error: `time_constant` must be greater than 0, but is 0
    4 | t = { type = "lag", in = "shaft.velocity", time_constant = "0 s" }
      |                                                            ^
)~"},
      {R"~(l = { type = "limiter", in = "shaft.velocity", upper = "2 rad/s", lower = "3 rad/s" }
)~",
       R"~(
scene.toml:4:56: error: `upper` is less than `lower`, which is -upper unless it is given
    4 | l = { type = "limiter", in = "shaft.velocity", upper = "2 rad/s", lower = "3 rad/s" }
      |                                                        ^
)~"},
      {R"~(x = { type = "delay", in = "shaft.velocity", delay = "-1 ms" }
)~",
       R"~(
scene.toml:4:54: error: `delay` must be at least 0, but is -0.001 s
    4 | x = { type = "delay", in = "shaft.velocity", delay = "-1 ms" }
      |                                                      ^
)~"},
  };
  for (const Bad& bad : cases) check_messages(bad);
}

TEST_CASE("bad netlists: units of blocks") {
  const Bad cases[] = {
      {R"~(g = { type = "generator", signal = { step = "7 rad/s", offset = "1 N*m" } }
)~",
       R"~(
scene.toml:4:45: error: `step`: expected a torque or an energy (N*m), as the rest of `signal`, found an angular velocity (rad/s)
    4 | g = { type = "generator", signal = { step = "7 rad/s", offset = "1 N*m" } }
      |                                             ^
)~"},
      {R"~(f = { type = "sum", in = ["shaft.velocity", "-j.force"] }
)~",
       R"~(
scene.toml:4:45: error: `j.force` is a torque or an energy (N*m), but the other inputs of `f` are an angular velocity (rad/s)
    4 | f = { type = "sum", in = ["shaft.velocity", "-j.force"] }
      |                                             ^
  all inputs of a block have one unit: put a `gain` before it
)~"},
      {R"~(l = { type = "limiter", in = "shaft.velocity", upper = "2 N*m" }
)~",
       R"~(
scene.toml:4:56: error: `upper`: expected an angular velocity (rad/s), as what the block takes in, found a torque or an energy (N*m)
    4 | l = { type = "limiter", in = "shaft.velocity", upper = "2 N*m" }
      |                                                        ^
)~"},
      {R"~(i = { type = "integrator", in = "shaft.velocity", initial = "2 N*m" }
)~",
       R"~(
scene.toml:4:61: error: `initial`: expected an angle (rad), as what the block puts out, found a torque or an energy (N*m)
    4 | i = { type = "integrator", in = "shaft.velocity", initial = "2 N*m" }
      |                                                             ^
)~"},
      {R"~(t = { type = "lag", in = "shaft.velocity", time_constant = "1 s" }
n = { type = "torque", at = "shaft", torque = { block = "t" } }
)~",
       R"~(
scene.toml:5:57: error: `torque` from block `t`: expected a torque (N*m), found an angular velocity (rad/s)
    5 | n = { type = "torque", at = "shaft", torque = { block = "t" } }
      |                                                         ^
)~"},
      {R"~(t = { type = "gain", in = "shaft.velocity", gain = "3 N*m" }
n = { type = "torque", at = "shaft", torque = { block = "-t" } }
)~",
       R"~(
scene.toml:5:57: error: `torque` from block `t`: expected a torque (N*m), found a power (W)
    5 | n = { type = "torque", at = "shaft", torque = { block = "-t" } }
      |                                                         ^
)~"},
  };
  for (const Bad& bad : cases) check_messages(bad);
}

TEST_CASE("bad netlists: functions of blocks") {
  const Bad cases[] = {
      {R"~(f = { type = "function", in = ["shaft.velocity", "j.force"] }
)~",
       R"~(
scene.toml:4:1: error: a `function` needs `out`
    4 | f = { type = "function", in = ["shaft.velocity", "j.force"] }
      | ^
  an expression over the inputs and the time: "u1*u2"
)~"},
      {R"~(f = { type = "function", in = "shaft.velocity", out = 3 }
)~",
       R"~(
scene.toml:4:55: error: `out` must be a string, but is the number 3
    4 | f = { type = "function", in = "shaft.velocity", out = 3 }
      |                                                       ^
  an expression over the inputs and the time: "u1*u2"
)~"},
      {R"~(f = { type = "function", in = ["shaft.velocity", "shaft.position"], out = "2*u1 + u2" }
)~",
       R"~(
scene.toml:4:83: error: the output of `f`: `2*u1` is an angular velocity (rad/s), `u2` is an angle (rad): they cannot be added
    4 | f = { type = "function", in = ["shaft.velocity", "shaft.position"], out = "2*u1 + u2" }
      |                                                                                   ^
)~"},
      {R"~(f = { type = "function", in = "shaft.velocity", out = "u1*u2" }
)~",
       R"~(
scene.toml:4:59: error: the output of `f`: unknown name `u2`
    4 | f = { type = "function", in = "shaft.velocity", out = "u1*u2" }
      |                                                           ^
  did you mean `u1`? known here are `u1` (shaft.velocity), the time `t` and the parameters
)~"},
      {R"~(f = { type = "function", in = "shaft.velocity", out = "-u1" }
n = { type = "torque", at = "shaft", torque = { block = "f" } }
)~",
       R"~(
scene.toml:5:57: error: `torque` from block `f`: expected a torque (N*m), found an angular velocity (rad/s)
    5 | n = { type = "torque", at = "shaft", torque = { block = "f" } }
      |                                                         ^
)~"},
      {R"~(f = { type = "function", in = ["shaft.velocity", "l"], out = "u1 + 2*u2" }
l = { type = "integrator", in = "f", gain = "2 N*m/rad" }
)~",
       R"~(
scene.toml:4:68: error: the output of `f`: `u1` is an angular velocity (rad/s), `2*u2` is a torque or an energy (N*m): they cannot be added
    4 | f = { type = "function", in = ["shaft.velocity", "l"], out = "u1 + 2*u2" }
      |                                                                    ^
)~"},
  };
  for (const Bad& bad : cases) check_messages(bad);
}

TEST_CASE("bad netlists: tables of blocks") {
  const Bad cases[] = {
      {R"~(l = { type = "lookup", in = "shaft.velocity" }
)~",
       R"~(
scene.toml:4:1: error: a `lookup` needs `table`
    4 | l = { type = "lookup", in = "shaft.velocity" }
      | ^
  points [input, output], or the name of a CSV file: table = [["0 m", "0 N"], ["1 m", "5 N"]]
)~"},
      {R"~(l = { type = "lookup", in = "shaft.velocity", table = [[0, 1], [2, 3, 4]] }
)~",
       R"~(
scene.toml:4:64: error: a point of a table is an array of two values, [input, output], but this has 3
    4 | l = { type = "lookup", in = "shaft.velocity", table = [[0, 1], [2, 3, 4]] }
      |                                                                ^
)~"},
      {R"~(l = { type = "lookup", in = "shaft.velocity", table = [[2, 1], [1, 0]] }
n = { type = "torque", at = "shaft", torque = { block = "l" } }
)~",
       R"~(
scene.toml:4:65: error: the inputs of a table must not decrease, but 1 follows 2
    4 | l = { type = "lookup", in = "shaft.velocity", table = [[2, 1], [1, 0]] }
      |                                                                 ^
)~"},
      {R"~(l = { type = "lookup", in = "shaft.velocity", table = [[1, 1], [1, 0]], smooth = true }
)~",
       R"~(
scene.toml:4:65: error: a smooth table cannot jump, but has two points at one input
    4 | l = { type = "lookup", in = "shaft.velocity", table = [[1, 1], [1, 0]], smooth = true }
      |                                                                 ^
)~"},
      {R"~(l = { type = "lookup", in = "shaft.velocity", table = [["1 rad/s", "2 N*m"], ["2 rad/s", "3 rad"]] }
)~",
       R"~(
scene.toml:4:90: error: the output of a point: expected a torque or an energy (N*m), as the other outputs, found an angle (rad)
    4 | l = { type = "lookup", in = "shaft.velocity", table = [["1 rad/s", "2 N*m"], ["2 rad/s", "3 rad"]] }
      |                                                                                          ^
)~"},
      {R"~(l = { type = "lookup", in = "shaft.position", table = [["1 rad/s", "2 N*m"], ["2 rad/s", "3 N*m"]] }
)~",
       R"~(
scene.toml:4:55: error: the inputs of the table are an angular velocity (rad/s), but what `l` takes in is an angle (rad)
    4 | l = { type = "lookup", in = "shaft.position", table = [["1 rad/s", "2 N*m"], ["2 rad/s", "3 N*m"]] }
      |                                                       ^
)~"},
      {R"~(l = { type = "lookup", in = "shaft.velocity", table = [["0 rad/s", "0 N*m"], ["1 rad/s", "2 rad"]], columns = ["a", "b"] }
)~",
       R"~(
scene.toml:4:101: error: `columns` names columns of a CSV file, but `table` names none
    4 | ...= { type = "lookup", in = "shaft.velocity", table = [["0 rad/s", "0 N*m"], ["1 rad/s", "2 rad"]], columns = ["a", "b"] }
      |                                                                                                      ^
  table = "measured.csv", columns = ["gap", "force"]
)~"},
  };
  for (const Bad& bad : cases) check_messages(bad);
}

TEST_CASE("bad netlists: transfer functions and samples") {
  const Bad cases[] = {
      {R"~(y = { type = "transfer", in = "shaft.velocity" }
)~",
       R"~(
scene.toml:4:1: error: a `transfer` needs `numerator`
    4 | y = { type = "transfer", in = "shaft.velocity" }
      | ^
  coefficients of the powers of s, the highest first: ["0.1 s", 1] is 0.1 s + 1
scene.toml:4:1: error: a `transfer` needs `denominator`
    4 | y = { type = "transfer", in = "shaft.velocity" }
      | ^
  coefficients of the powers of s, the highest first: ["0.1 s", 1] is 0.1 s + 1
)~"},
      {R"~(y = { type = "transfer", in = "shaft.velocity", numerator = [], denominator = { s = 1 } }
)~",
       R"~(
scene.toml:4:61: error: `numerator` has no coefficients
    4 | y = { type = "transfer", in = "shaft.velocity", numerator = [], denominator = { s = 1 } }
      |                                                             ^
  coefficients of the powers of s, the highest first: ["0.1 s", 1] is 0.1 s + 1
scene.toml:4:79: error: `denominator` must be an array of coefficients, but is a table
    4 | y = { type = "transfer", in = "shaft.velocity", numerator = [], denominator = { s = 1 } }
      |                                                                               ^
  coefficients of the powers of s, the highest first: ["0.1 s", 1] is 0.1 s + 1
)~"},
      {R"~(y = { type = "transfer", in = "shaft.velocity", numerator = [1, 2, 3], denominator = [1, 2] }
)~",
       R"~(
scene.toml:4:61: error: `numerator` has a higher degree than `denominator`: the transfer function would differentiate its input
    4 | y = { type = "transfer", in = "shaft.velocity", numerator = [1, 2, 3], denominator = [1, 2] }
      |                                                             ^
)~"},
      {R"~(y = { type = "transfer", in = "shaft.velocity", numerator = 1, denominator = [0, 2] }
)~",
       R"~(
scene.toml:4:78: error: `denominator` begins with 0: its first coefficient, that of the highest power of s, must not be 0
    4 | y = { type = "transfer", in = "shaft.velocity", numerator = 1, denominator = [0, 2] }
      |                                                                              ^
)~"},
      {R"~(y = { type = "transfer", in = "shaft.velocity", numerator = [inf, 1], denominator = [1, "2 m", "3 s"] }
)~",
       R"~(
scene.toml:4:62: error: the coefficient of s of `numerator` must be finite, but is infinite
    4 | y = { type = "transfer", in = "shaft.velocity", numerator = [inf, 1], denominator = [1, "2 m", "3 s"] }
      |                                                              ^
)~"},
      {R"~(y = { type = "transfer", in = "shaft.velocity", numerator = 1, denominator = ["0.1 s", 1, "5 Hz"] }
)~",
       R"~(
scene.toml:4:91: error: the constant coefficient of `denominator`: s is in radians a second, found a frequency (Hz)
    4 | y = { type = "transfer", in = "shaft.velocity", numerator = 1, denominator = ["0.1 s", 1, "5 Hz"] }
      |                                                                                           ^
  an angular frequency is `2*pi` times a frequency
)~"},
      {R"~(y = { type = "sample", in = "shaft.velocity", period = 0, quantum = "1 N*m" }
z = { type = "sample", in = "shaft.velocity" }
)~",
       R"~(
scene.toml:4:56: error: `period` must be greater than 0, but is 0
    4 | y = { type = "sample", in = "shaft.velocity", period = 0, quantum = "1 N*m" }
      |                                                        ^
scene.toml:5:1: error: a `sample` needs `period`
    5 | z = { type = "sample", in = "shaft.velocity" }
      | ^
  a time, in s: time between two samples
)~"},
  };
  for (const Bad& bad : cases) check_messages(bad);
}

}  // namespace rheonet::test::bad_blocks_test
