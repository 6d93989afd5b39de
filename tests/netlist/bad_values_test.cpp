#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_values_test {

TEST_CASE("bad netlists: values") {
  check_all({
      {"an unknown unit",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/furlog" }
)~",
       R"~(
scene.toml:2:71: error: `stiffness`: unknown unit `furlog`
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/furlog" }
      |                                                                       ^
)~"},
      {"a length for a stiffness",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "2 mm" }
)~",
       R"~(
scene.toml:2:64: error: `stiffness`: expected a stiffness (N/m), found a length (m)
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "2 mm" }
      |                                                                ^
)~"},
      {"a unit of translation in a rotational scene",
       R"~(
domain = "rotation"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "2 N/m" }
)~",
       R"~(
scene.toml:3:64: error: `stiffness`: expected a torsional stiffness (N*m/rad), found a stiffness (N/m)
    3 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "2 N/m" }
      |                                                                ^
  this is of rotation, by `domain` or by another element at its nodes
)~"},
      {"an expression of another dimension",
       R"~(
[parameters]
k = "100 N/m"
m = "2 kg"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "k/m" }
)~",
       R"~(
scene.toml:5:64: error: `stiffness`: expected a stiffness (N/m), found a quantity in s^-2
    5 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "k/m" }
      |                                                                ^
)~"},
      {"a force in place of a torque",
       R"~(
domain = "rotation"
[elements]
b1 = { type = "slider", between = ["a", "ground"], coulomb = "2 kN" }
)~",
       R"~(
scene.toml:3:62: error: `coulomb`: expected a torque (N*m), found a force (N)
    3 | b1 = { type = "slider", between = ["a", "ground"], coulomb = "2 kN" }
      |                                                              ^
  this is of rotation, by `domain` or by another element at its nodes; a force times the radius at which it acts is a torque
)~"},
      {"a sum of two dimensions",
       R"~(
[parameters]
k = "100 N/m"
m = "2 kg"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "k + m" }
)~",
       R"~(
scene.toml:5:69: error: `stiffness`: `k` is a stiffness (N/m), `m` is a mass (kg): they cannot be added
    5 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "k + m" }
      |                                                                     ^
)~"},
      {"a mistyped parameter",
       R"~(
[parameters]
stiff = "100 N/m"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "2*stif" }
)~",
       R"~(
scene.toml:4:67: error: `stiffness`: unknown name `stif`
    4 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "2*stif" }
      |                                                                   ^
  did you mean `stiff`?
)~"},
      {"an expression that ends too early",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "2*(3+" }
)~",
       R"~(
scene.toml:2:70: error: `stiffness`: the expression ends too early
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "2*(3+" }
      |                                                                      ^
)~"},
      {"a quantity within an expression",
       R"~(
[parameters]
f = 2
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/m*f" }
)~",
       R"~(
scene.toml:4:73: error: `stiffness`: unknown unit `f`
    4 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "100 N/m*f" }
      |                                                                         ^
  a quantity is one number and a unit, it cannot be part of an expression: give it a name in [parameters]
)~"},
      {"a damping whose unit does not go with the flow index",
       R"~(
[elements]
c1 = { type = "dashpot", between = ["a", "ground"], damping = "3 N*s/m", flow_index = 0.5 }
)~",
       R"~(
scene.toml:2:63: error: `damping`: expected a damping (N*(s/m)^0.5), found a damping (N*s/m)
    2 | c1 = { type = "dashpot", between = ["a", "ground"], damping = "3 N*s/m", flow_index = 0.5 }
      |                                                               ^
  with a flow index of 0.5, force = damping * velocity^0.5
)~"},
      {"a length for a time",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
[simulate]
stop = "2 m"
)~",
       R"~(
scene.toml:4:8: error: `stop`: expected a time (s), found a length (m)
    4 | stop = "2 m"
      |        ^
)~"},
      {"a boolean for a number",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = true }
)~",
       R"~(
scene.toml:2:64: error: `stiffness` must be a number or a string with a quantity or an expression, but is `true`
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = true }
      |                                                                ^
)~"},
      {"a value below its bound",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "-3 N/m" }
)~",
       R"~(
scene.toml:2:64: error: `stiffness` must be greater than 0, but is -3 N/m
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "-3 N/m" }
      |                                                                ^
)~"},
      {"a value above its bound",
       R"~(
[elements]
c1 = { type = "dashpot", between = ["a", "ground"], damping = 1, flow_index = 7 }
)~",
       R"~(
scene.toml:2:79: error: `flow_index` must be at most 4, but is 7
    2 | c1 = { type = "dashpot", between = ["a", "ground"], damping = 1, flow_index = 7 }
      |                                                                               ^
)~"},
      {"infinity where there is no limit",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "inf" }
)~",
       R"~(
scene.toml:2:64: error: `stiffness` must be finite, but is infinite
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "inf" }
      |                                                                ^
  "inf" is for laws that become another one there, and this one does not; a value large beside those around it comes close
)~"},
      {"minus infinity, and infinity of what is no magnitude",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = -inf }
k2 = { type = "spring", between = ["a", "ground"], stiffness = 1, f0 = inf }
)~",
       R"~(
scene.toml:2:64: error: `stiffness` must be finite, but is infinite
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = -inf }
      |                                                                ^
scene.toml:3:72: error: `f0` must be finite, but is infinite
    3 | k2 = { type = "spring", between = ["a", "ground"], stiffness = 1, f0 = inf }
      |                                                                        ^
)~"},
      {"infinity with a unit",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "inf N/m" }
)~",
       R"~(
scene.toml:2:65: error: `stiffness`: `inf` has no unit
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "inf N/m" }
      |                                                                 ^
  an infinite value is "inf" alone
)~"},
      {"NaN",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = nan }
)~",
       R"~(
scene.toml:2:64: error: `stiffness` is not a number (NaN)
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = nan }
      |                                                                ^
)~"},
      {"an expression without a value",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "sqrt(-1)" }
)~",
       R"~(
scene.toml:2:65: error: `stiffness`: `sqrt(-1)` is not a number
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "sqrt(-1)" }
      |                                                                 ^
  is it the root or logarithm of a negative number, or 0/0?
)~"},
      {"a division by zero",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "1/0" }
)~",
       R"~(
scene.toml:2:65: error: `stiffness`: `1/0` is infinite
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = "1/0" }
      |                                                                 ^
  is it a division by zero? ("inf" alone is a limit)
)~"},
      {"parameters in a circle",
       R"~(
[parameters]
a = "2*b"
b = "c + 1"
c = "a"
d = "a"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "d" }
)~",
       R"~(
scene.toml:2:1: error: parameters depend on each other in a circle: `a` -> `b` -> `c` -> `a`
    2 | a = "2*b"
      | ^
  one of them must be given by numbers
)~"},
      {"a parameter that depends on itself",
       R"~(
[parameters]
a = "2*a"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "a" }
)~",
       R"~(
scene.toml:2:1: error: parameters depend on each other in a circle: `a` -> `a`
    2 | a = "2*a"
      | ^
  one of them must be given by numbers
)~"},
      {"names that no expression could use",
       R"~(
[parameters]
"2a" = 1
pi = 3
"a-b" = 3
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:1: error: `2a` is no name for a parameter
    2 | "2a" = 1
      | ^
  names that expressions use are made of letters, digits and `_`, and begin with no digit
scene.toml:3:1: error: `pi` cannot name a parameter: it is a number already
    3 | pi = 3
      | ^
  choose another name
scene.toml:4:1: error: `a-b` is no name for a parameter
    4 | "a-b" = 3
      | ^
  names that expressions use are made of letters, digits and `_`, and begin with no digit
)~"},
      {"a parameter that is no number",
       R"~(
[parameters]
a = true
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "a" }
)~",
       R"~(
scene.toml:2:5: error: `a` must be a number or a string with a quantity or an expression, but is `true`
    2 | a = true
      |     ^
)~"},
  });
}

}  // namespace rheonet::test::bad_values_test
