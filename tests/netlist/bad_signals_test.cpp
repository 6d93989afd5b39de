#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_signals_test {

TEST_CASE("bad netlists: signals") {
  check_all({
      {"signals",
       R"~(
[elements]
a = { type = "motion", at = "a", velocity = { stp = 1 } }
b = { type = "motion", at = "b", velocity = { step = 1, sine = 2 } }
c = { type = "motion", at = "c", velocity = { sine = 1 } }
d = { type = "motion", at = "d", velocity = { step = 1, frequency = 3 } }
e = { type = "motion", at = "e", velocity = { step = "1 m" } }
f = { type = "motion", at = "f", velocity = { ramp = "1 m/s" } }
g = { type = "motion", at = "g", velocity = { sine = "1 m", amplitude = "1 m/s", frequency = 1 } }
h = { type = "motion", at = "h", velocity = { sine = 1, frequency = "3 s" } }
i = { type = "motion", at = "i", velocity = { sine = 1, frequency = -3 } }
j = { type = "motion", at = "j", velocity = { sine = 1, frequency = 3, phase = "2 m" } }
k = { type = "motion", at = "k", velocity = { pulse = 1, width = 2, frequency = 1 } }
l = { type = "motion", at = "l", velocity = { table = [[0, 0], [1]] } }
m = { type = "motion", at = "m", velocity = { table = [[0, 0], [-1, 2]] } }
n = { type = "motion", at = "n", velocity = { table = [] } }
o = { type = "motion", at = "o", velocity = { table = [[0, "1 m"]] } }
p = { type = "motion", at = "p", velocity = { table = 3 } }
q = { type = "motion", at = "q", velocity = [1, 2] }
r = { type = "motion", at = "r", velocity = inf }
s = { type = "motion", at = "s", velocity = {} }
t = { type = "motion", at = "t", velocity = { chirp = 1, frequency = 1 } }
u = { type = "motion", at = "u", velocity = { time = 1 } }
v = { type = "motion", at = "v", velocity = { step = 1, time = nan } }
w = { type = "motion", at = "w", velocity = { table = [[0, 0], [1, nan]] } }
x = { type = "motion", at = "x", velocity = { pulse = 1, width = 2, phase = "90 deg" } }
y = { type = "motion", at = "y", velocity = { table = [[0, 0], [1, 2]], smooth = "yes" } }
z = { type = "motion", at = "z", velocity = { ramp = 3, smooth = true } }
)~",
       R"~(
scene.toml:2:47: error: signal `velocity` has no shape
    2 | a = { type = "motion", at = "a", velocity = { stp = 1 } }
      |                                               ^
  did you mean `step`?
scene.toml:3:57: error: signal `velocity` is both a `step` and a `sine`
    3 | b = { type = "motion", at = "b", velocity = { step = 1, sine = 2 } }
      |                                                         ^
  a signal has one shape
scene.toml:4:47: error: a `sine` signal needs `frequency`
    4 | c = { type = "motion", at = "c", velocity = { sine = 1 } }
      |                                               ^
scene.toml:5:57: error: unknown key `frequency` of a `step` signal
    5 | d = { type = "motion", at = "d", velocity = { step = 1, frequency = 3 } }
      |                                                         ^
  its keys are `step`, `amplitude`, `time` and `offset`
scene.toml:6:54: error: `step`: expected a velocity (m/s), found a length (m)
    6 | e = { type = "motion", at = "e", velocity = { step = "1 m" } }
      |                                                      ^
scene.toml:7:54: error: `ramp`: expected the rise of `velocity` per second (m/s^2), found a velocity (m/s)
    7 | f = { type = "motion", at = "f", velocity = { ramp = "1 m/s" } }
      |                                                      ^
scene.toml:8:54: error: `sine`: expected a velocity (m/s), found a kinematic viscosity (m^2/s)
    8 | g = { type = "motion", at = "g", velocity = { sine = "1 m", amplitude = "1 m/s", frequency = 1 } }
      |                                                      ^
  `amplitude` multiplies `sine`: one of them has the unit, the other is a number
scene.toml:9:69: error: `frequency`: expected a frequency (Hz), found a time (s)
    9 | h = { type = "motion", at = "h", velocity = { sine = 1, frequency = "3 s" } }
      |                                                                     ^
scene.toml:10:69: error: `frequency` must be greater than 0, but is -3 Hz
   10 | i = { type = "motion", at = "i", velocity = { sine = 1, frequency = -3 } }
      |                                                                     ^
scene.toml:11:80: error: `phase`: expected an angle (rad), found a length (m)
   11 | j = { type = "motion", at = "j", velocity = { sine = 1, frequency = 3, phase = "2 m" } }
      |                                                                                ^
scene.toml:12:66: error: `width` must be less than the period, 1/`frequency`
   12 | k = { type = "motion", at = "k", velocity = { pulse = 1, width = 2, frequency = 1 } }
      |                                                                  ^
scene.toml:13:64: error: a point of a table is an array of two values, [time, value], but this has 1
   13 | l = { type = "motion", at = "l", velocity = { table = [[0, 0], [1]] } }
      |                                                                ^
scene.toml:14:65: error: the times of a table must not decrease, but -1 s follows 0 s
   14 | m = { type = "motion", at = "m", velocity = { table = [[0, 0], [-1, 2]] } }
      |                                                                 ^
scene.toml:15:55: error: `table` has no points
   15 | n = { type = "motion", at = "n", velocity = { table = [] } }
      |                                                       ^
scene.toml:16:60: error: the value of a point: expected a velocity (m/s), found a length (m)
   16 | o = { type = "motion", at = "o", velocity = { table = [[0, "1 m"]] } }
      |                                                            ^
scene.toml:17:55: error: `table` must be an array of points or the name of a CSV file, but is the number 3
   17 | p = { type = "motion", at = "p", velocity = { table = 3 } }
      |                                                       ^
  points are given so: table = [[0, 0], [1, 0.5]]
scene.toml:18:45: error: `velocity` must be a number, a string or a table, but is an array
   18 | q = { type = "motion", at = "q", velocity = [1, 2] }
      |                                             ^
  points are given so: { table = [[0, 0], [1, 0.5]] }
scene.toml:19:45: error: `velocity` must be finite, but is infinite
   19 | r = { type = "motion", at = "r", velocity = inf }
      |                                             ^
scene.toml:20:45: error: signal `velocity` has no shape
   20 | s = { type = "motion", at = "s", velocity = {} }
      |                                             ^
  expected one of `step`, `ramp`, `sine`, `cosine`, `square`, `triangle`, `chirp`, `pulse`, `noise` or `table`
scene.toml:21:47: error: a `chirp` signal needs `end_frequency`
   21 | t = { type = "motion", at = "t", velocity = { chirp = 1, frequency = 1 } }
      |                                               ^
scene.toml:21:47: error: a `chirp` signal needs `duration`
   21 | t = { type = "motion", at = "t", velocity = { chirp = 1, frequency = 1 } }
      |                                               ^
scene.toml:22:45: error: signal `velocity` has no shape
   22 | u = { type = "motion", at = "u", velocity = { time = 1 } }
      |                                             ^
  expected one of `step`, `ramp`, `sine`, `cosine`, `square`, `triangle`, `chirp`, `pulse`, `noise` or `table`
scene.toml:23:64: error: `time` is not a number (NaN)
   23 | v = { type = "motion", at = "v", velocity = { step = 1, time = nan } }
      |                                                                ^
scene.toml:24:68: error: the value of a point is not a number (NaN)
   24 | w = { type = "motion", at = "w", velocity = { table = [[0, 0], [1, nan]] } }
      |                                                                    ^
scene.toml:25:77: error: a `pulse` without `frequency` has no `phase`
   25 | x = { type = "motion", at = "x", velocity = { pulse = 1, width = 2, phase = "90 deg" } }
      |                                                                             ^
  `time` says when it begins
scene.toml:26:82: error: `smooth` must be true or false, but is the string "yes"
   26 | y = { type = "motion", at = "y", velocity = { table = [[0, 0], [1, 2]], smooth = "yes" } }
      |                                                                                  ^
  smooth = true
scene.toml:27:57: error: unknown key `smooth` of a `ramp` signal
   27 | z = { type = "motion", at = "z", velocity = { ramp = 3, smooth = true } }
      |                                                         ^
  its keys are `ramp`, `amplitude`, `time`, `offset` and `duration`
)~"},
      {"expressions of the time",
       R"~(
[elements]
a = { type = "motion", at = "a", velocity = "2*sin(3*t)" }
b = { type = "force", at = "b", force = { step = "time" } }
)~",
       R"~(
scene.toml:2:45: error: `velocity`: there is no parameter `t`, and an expression here cannot depend on the time
    2 | a = { type = "motion", at = "a", velocity = "2*sin(3*t)" }
      |                                             ^
  what changes is the output of a `function`, { block = "f" }, or a table, { sine = "1 m/s", frequency = "2 Hz" }; there are `step`, `ramp`, `sine`, `cosine`, `square`, `triangle`, `chirp`, `pulse`, `noise` and `table`
scene.toml:3:50: error: `step`: there is no parameter `time`, and an expression here cannot depend on the time
    3 | b = { type = "force", at = "b", force = { step = "time" } }
      |                                                  ^
  what changes is the output of a `function`, { block = "f" }, or a table, { sine = "1 N", frequency = "2 Hz" }; there are `step`, `ramp`, `sine`, `cosine`, `square`, `triangle`, `chirp`, `pulse`, `noise` and `table`
)~"},
      {"the name of a block, and names that are none",
       R"~(
[parameters]
delta = "2 N"
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
a = { type = "force", at = "a", force = "late" }
b = { type = "force", at = "a", force = "detla" }
c = { type = "force", at = "a", force = "2*late" }
d = { type = "force", at = "a", force = { sine = "late", frequency = 1 } }
)~",
       R"~(
scene.toml:5:41: error: `force`: there is no parameter `late`
    5 | a = { type = "force", at = "a", force = "late" }
      |                                         ^
  the output of a block is given so: { block = "late" }
scene.toml:6:42: error: `force`: unknown name `detla`
    6 | b = { type = "force", at = "a", force = "detla" }
      |                                          ^
  did you mean `delta`?
scene.toml:7:44: error: `force`: unknown name `late`
    7 | c = { type = "force", at = "a", force = "2*late" }
      |                                            ^
  it must be a parameter
scene.toml:8:51: error: `sine`: unknown name `late`
    8 | d = { type = "force", at = "a", force = { sine = "late", frequency = 1 } }
      |                                                   ^
  it must be a parameter
)~"},
      {"a unit in the amplitude and in what it multiplies, or in one of them and wrong",
       R"~(
[elements]
a = { type = "motion", at = "a", velocity = { sine = "1 m/s", amplitude = "2 m/s", frequency = 1 } }
b = { type = "motion", at = "b", velocity = { ramp = "1 m/s^2", amplitude = "2 m/s" } }
c = { type = "motion", at = "c", velocity = { table = [[0, "1 m/s"]], amplitude = "2 m/s" } }
d = { type = "motion", at = "d", velocity = { sine = "1 m", amplitude = 2, frequency = 1 } }
)~",
       R"~(
scene.toml:2:54: error: `sine`: expected a velocity (m/s), found a quantity in m^2*s^-2
    2 | a = { type = "motion", at = "a", velocity = { sine = "1 m/s", amplitude = "2 m/s", frequency = 1 } }
      |                                                      ^
  `amplitude` multiplies `sine`: one of them has the unit, the other is a number
scene.toml:3:54: error: `ramp`: expected the rise of `velocity` per second (m/s^2), found a quantity in m^2*s^-3
    3 | b = { type = "motion", at = "b", velocity = { ramp = "1 m/s^2", amplitude = "2 m/s" } }
      |                                                      ^
  `amplitude` multiplies `ramp`: one of them has the unit, the other is a number
scene.toml:4:60: error: the value of a point: expected a velocity (m/s), found a quantity in m^2*s^-2
    4 | c = { type = "motion", at = "c", velocity = { table = [[0, "1 m/s"]], amplitude = "2 m/s" } }
      |                                                            ^
  `amplitude` multiplies the value of a point: one of them has the unit, the other is a number
scene.toml:5:54: error: `sine`: expected a velocity (m/s), found a length (m)
    5 | d = { type = "motion", at = "d", velocity = { sine = "1 m", amplitude = 2, frequency = 1 } }
      |                                                      ^
)~"},
      {"noise",
       R"~(
[elements]
a = { type = "motion", at = "a", velocity = { noise = 1 } }
b = { type = "motion", at = "b", velocity = { noise = 1, interval = 0, seed = 1 } }
c = { type = "motion", at = "c", velocity = { noise = 1, interval = "1 m", seed = 1.5 } }
d = { type = "motion", at = "d", velocity = { noise = 1, interval = 1, seed = -1 } }
e = { type = "motion", at = "e", velocity = { noise = "1 m", interval = 1, seed = 9007199254740994 } }
f = { type = "motion", at = "f", velocity = { noise = 1, interval = 1, seed = 1, frequency = 2 } }
g = { type = "motion", at = "g", velocity = { noise = 1, interval = 1, seed = "1 s" } }
)~",
       R"~(
scene.toml:2:47: error: a `noise` signal needs `interval`
    2 | a = { type = "motion", at = "a", velocity = { noise = 1 } }
      |                                               ^
  the time for which each value holds
scene.toml:2:47: error: a `noise` signal needs `seed`
    2 | a = { type = "motion", at = "a", velocity = { noise = 1 } }
      |                                               ^
  a whole number: signals of one seed have the same values
scene.toml:3:69: error: `interval` must be greater than 0, but is 0 s
    3 | b = { type = "motion", at = "b", velocity = { noise = 1, interval = 0, seed = 1 } }
      |                                                                     ^
scene.toml:4:69: error: `interval`: expected a time (s), found a length (m)
    4 | c = { type = "motion", at = "c", velocity = { noise = 1, interval = "1 m", seed = 1.5 } }
      |                                                                     ^
scene.toml:4:83: error: `seed` must be a whole number from 0 to 9007199254740992, but is 1.5
    4 | c = { type = "motion", at = "c", velocity = { noise = 1, interval = "1 m", seed = 1.5 } }
      |                                                                                   ^
scene.toml:5:79: error: `seed` must be a whole number from 0 to 9007199254740992, but is -1
    5 | d = { type = "motion", at = "d", velocity = { noise = 1, interval = 1, seed = -1 } }
      |                                                                               ^
scene.toml:6:55: error: `noise`: expected a velocity (m/s), found a length (m)
    6 | e = { type = "motion", at = "e", velocity = { noise = "1 m", interval = 1, seed = 9007199254740994 } }
      |                                                       ^
scene.toml:6:83: error: `seed` must be a whole number from 0 to 9007199254740992, but is 9007199254740994
    6 | e = { type = "motion", at = "e", velocity = { noise = "1 m", interval = 1, seed = 9007199254740994 } }
      |                                                                                   ^
scene.toml:7:82: error: unknown key `frequency` of a `noise` signal
    7 | f = { type = "motion", at = "f", velocity = { noise = 1, interval = 1, seed = 1, frequency = 2 } }
      |                                                                                  ^
  its keys are `noise`, `interval`, `seed`, `amplitude`, `time` and `offset`
scene.toml:8:79: error: `seed`: expected a number without a unit, found a time (s)
    8 | g = { type = "motion", at = "g", velocity = { noise = 1, interval = 1, seed = "1 s" } }
      |                                                                               ^
)~"},
  });
}

}  // namespace rheonet::test::bad_signals_test
