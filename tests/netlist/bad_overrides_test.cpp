#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_overrides_test {

TEST_CASE("bad netlists: --set") {
  check_all({
      {"a multiplied value that the netlist does not give",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: the netlist gives no `stifness` that could be multiplied
      | --set k1.stifness*=3
      |          ^
  did you mean `stiffness`?
)~",
       {R"~(k1.stifness*=3)~"}},
      {"a table that is multiplied",
       R"~(
[elements]
drive = { type = "motion", at = "a", velocity = { step = 3, time = 1 } }
)~",
       R"~(
command line: error: `drive.velocity` is a table, which cannot be multiplied
      | --set drive.velocity*=3
      |             ^
  name one number of it, a quantity or an expression
)~",
       {R"~(drive.velocity*=3)~"}},
      {"a parameter without its table",
       R"~(
[parameters]
K = "3 N/m"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "K" }
)~",
       R"~(
command line: error: no element is called `K`
      | --set K=3
      |       ^
  the path of the parameter is `parameters.K`
)~",
       {R"~(K=3)~"}},
      {"a text that is multiplied",
       R"~(
title = "A spring"
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: `title` is the string "A spring", which cannot be multiplied
      | --set title*=3
      |       ^
  name one number of it, a quantity or an expression
)~",
       {R"~(title*=3)~"}},
      {"a node that is multiplied",
       R"~(
[elements]
m1 = { type = "mass", at = "a", mass = 1 }
)~",
       R"~(
command line: error: `m1.at` is the string "a", which cannot be multiplied
      | --set m1.at*=3
      |          ^
  name one number of it, a quantity or an expression
)~",
       {R"~(m1.at*=3)~"}},
      {"a factor that is no number",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: expected a number after `*=`, found the string "3 N/m"
      | --set k1.stiffness*=3 N/m
      |                     ^
  for instance --set k1.stiffness*=1.1
)~",
       {R"~(k1.stiffness*=3 N/m)~"}},
      {"an element in place of one of its values",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: `k1` is an element, which the string "3 N/m" cannot replace
      | --set k1=3 N/m
      |       ^
  name one of its values: `k1.stiffness`
)~",
       {R"~(k1=3 N/m)~"}},
      {"an unknown element",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: nothing is called `k2`
      | --set k2.stiffness=3
      |       ^
  did you mean `k1`?
)~",
       {R"~(k2.stiffness=3)~"}},
      {"a mistyped key",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: unknown key `stifness` of a `spring`
      | --set k1.stifness=3
      |          ^
  did you mean `stiffness`?
)~",
       {R"~(k1.stifness=3)~"}},
      {"a wrong unit",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: `stiffness`: expected a stiffness (N/m), found a length (m)
      | --set k1.stiffness=3 mm
      |                    ^
)~",
       {R"~(k1.stiffness=3 mm)~"}},
      {"an unknown name in an expression",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: `stiffness`: unknown name `q`
      | --set k1.stiffness=3*q
      |                      ^
  it must be a parameter
)~",
       {R"~(k1.stiffness=3*q)~"}},
      {"no value",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: expected PATH=VALUE, found `k1.stiffness`
      | --set k1.stiffness
      |       ^
  for instance --set k1.stiffness="2 N/m", or --set k1.stiffness*=2 for twice the value
)~",
       {R"~(k1.stiffness)~"}},
      {"an empty part of a path",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: expected PATH=VALUE, found `k1..stiffness=3`
      | --set k1..stiffness=3
      |       ^
  for instance --set k1.stiffness="2 N/m", or --set k1.stiffness*=2 for twice the value
)~",
       {R"~(k1..stiffness=3)~"}},
      {"a key of a number",
       R"~(
[elements]
drive = { type = "motion", at = "a", velocity = 3 }
)~",
       R"~(
command line: error: `drive.velocity` is the number 3, it has no `step`
      | --set drive.velocity.step=3
      |                      ^
  give the whole of it: --set drive.velocity='{ step = ... }'
)~",
       {R"~(drive.velocity.step=3)~"}},
      {"a mistyped table",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: nothing is called `simulat`
      | --set simulat.stop=3
      |       ^
  did you mean `simulate`?
)~",
       {R"~(simulat.stop=3)~"}},
      {"a mistyped key of a table",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
command line: error: unknown key `stopp` of [simulate]
      | --set simulate.stopp=3
      |                ^
  did you mean `stop`?
)~",
       {R"~(simulate.stopp=3)~"}},
      {"an unknown model",
       R"~(
[models.m]
ports = ["a"]
elements = { k = { type = "spring", between = ["a", "ground"], stiffness = 1 } }
[elements]
k1 = { type = "m", at = "x" }
)~",
       R"~(
command line: error: there is no model `n`
      | --set models.n.parameters.k=3
      |              ^
  the models are `m`
)~",
       {R"~(models.n.parameters.k=3)~"}},
      {"names that are nowhere",
       R"~(
[models.m]
ports = ["a", "b"]
parameters = { k = 1 }
elements = { spr = { type = "spring", between = ["a", "b"], stiffness = "k" } }
[elements]
bing = { between = ["a", "ground"], series = [ { type = "spring", stiffness = 1 }, { name = "k1", type = "spring", stiffness = 1 } ] }
m = { type = "m", between = ["a", "b"] }
mchain = { type = "m", between = ["a", "b"], repeat = { count = 3 } }
chain = { type = "spring", stiffness = 1, between = ["a", "b"], repeat = { count = 3 } }
)~",
       R"~(
command line: error: nothing in `bing` is called `k9`
      | --set bing.k9.stiffness=3
      |            ^
  did you mean `k1`?
command line: error: nothing in `bing` is called `sprin1`
      | --set bing.sprin1.stiffness=3
      |            ^
  did you mean `spring1`?
command line: error: nothing in `m` is called `kk`
      | --set m.kk.stiffness=3
      |         ^
  did you mean `k`?
command line: error: nothing in `m` is called `K`
      | --set m.K=3
      |         ^
  did you mean `k`?
command line: error: unknown key `stif` of a `spring`
      | --set chain.stif=3
      |             ^
  its keys are `type`, `between`, `domain`, `stiffness`, `rest`, `f0` and `repeat`
command line: error: nothing in `mchain` is called `x`
      | --set mchain.x=3
      |              ^
  its members are called by their numbers, from 0
command line: error: nothing in `mchain.1` is called `x`
      | --set mchain.1.x=3
      |                ^
)~",
       {R"~(bing.k9.stiffness=3)~", R"~(bing.sprin1.stiffness=3)~", R"~(m.kk.stiffness=3)~", R"~(m.K=3)~",
        R"~(chain.stif=3)~", R"~(mchain.x=3)~", R"~(mchain.1.x=3)~"}},
      {"members that there are not",
       R"~(
[elements]
chain = { type = "spring", between = ["a", "ground"], stiffness = 1, repeat = { count = 5 } }
)~",
       R"~(
command line: error: `chain` has no member 7
      | --set chain.7.stiffness=3
      |             ^
  its members are `chain.0` to `chain.4`
command line: error: a member of a `repeat` stands where the whole puts it
      | --set chain.3=3
      |             ^
  only its values can be set, or those of the whole: `chain`
command line: error: a member of a `repeat` stands where the whole puts it
      | --set chain.3.between=["a","b"]
      |               ^
  only its values can be set, or those of the whole: `chain`
)~",
       {R"~(chain.7.stiffness=3)~", R"~(chain.3=3)~", R"~(chain.3.between=["a","b"])~"}},
      {"a parameter that nothing uses",
       R"~(
[parameters]
k = 3
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "k" }
)~",
       R"~(
command line: error: there is no parameter `K`, and nothing uses one
      | --set parameters.K=3
      |                  ^
  did you mean `k`?
)~",
       {R"~(parameters.K=3)~"}},
      {"a node that there is not",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = "1" }
)~",
       R"~(
command line: error: no element names a node `b`
      | --set nodes.b.position=7
      |             ^
  nodes exist by being named in an element
)~",
       {R"~(nodes.b.position=7)~"}},
      {"one of two keys that exclude each other, the other in the file",
       R"~(
[elements]
drive = { type = "motion", at = "a", position = 1 }
push = { type = "force", between = ["a", "b"], force = 1 }
)~",
       R"~(
command line: error: a `motion` has both `position` and `velocity`
      | --set drive.velocity=3
      |             ^
  only one of them can be given
command line: error: `push` has both `between` and `at`
      | --set push.at=a
      |            ^
  only one of them can be given
)~",
       {"drive.velocity=3", "push.at=a"}},
  });
}

}  // namespace rheonet::test::bad_overrides_test
