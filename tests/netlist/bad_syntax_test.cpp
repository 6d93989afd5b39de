#include <doctest/doctest.h>

#include "tests/netlist/reading.hpp"

namespace rheonet::test::bad_syntax_test {

TEST_CASE("bad netlists: what is no TOML") {
  check_all({
      {"a text without quotes",
       R"~(
[elements]
k1 = { type = spring, between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:15: error: `spring` is not a value
    2 | k1 = { type = spring, between = ["a", "ground"], stiffness = 1 }
      |               ^
  a text stands in quotes: "spring"
)~"},
      {"a string that is not closed",
       R"~(
title = "A spring
[elements]
)~",
       R"~(
scene.toml:1:9: error: this string is not closed on its line
    1 | title = "A spring
      |         ^
  close it with "
)~"},
      {"a header that is not closed",
       R"~(
[elements
k1 = 3
)~",
       R"~(
scene.toml:1:10: error: the header of a table is not closed
    1 | [elements
      |          ^
  close it with ]
)~"},
      {"a quantity without quotes",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 3 N/m }
)~",
       R"~(
scene.toml:2:66: error: unexpected `N/m` after a value
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = 3 N/m }
      |                                                                  ^
  a quantity or an expression stands in quotes: "3 N/m"
)~"},
      {"an inline table over two lines",
       R"~(
[elements]
k1 = { type = "spring",
       between = ["a", "ground"], stiffness = 1 }
)~",
       R"~(
scene.toml:2:24: error: the line ends within an inline table
    2 | k1 = { type = "spring",
      |                        ^
  close it with }: an inline table stands on one line; a long one can be a table of its own, [elements.name]
)~"},
      {"a comma at the end of an inline table",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1, }
)~",
       R"~(
scene.toml:2:67: error: an inline table may not end with a comma
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = 1, }
      |                                                                   ^
  remove the comma before `}`
)~"},
      {"an element given twice",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1 }
k1 = { type = "spring", between = ["a", "b"], stiffness = 2 }
)~",
       R"~(
scene.toml:3:1: error: key `k1` is given twice
    3 | k1 = { type = "spring", between = ["a", "b"], stiffness = 2 }
      | ^
  a key may stand only once in a table
)~"},
      {"a key given twice",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1, stiffness = 2 }
)~",
       R"~(
scene.toml:2:67: error: key `stiffness` is given twice
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = 1, stiffness = 2 }
      |                                                                   ^
  a key may stand only once in a table
)~"},
      {"a table given twice",
       R"~(
[simulate]
stop = 1
[simulate]
start = 0
)~",
       R"~(
scene.toml:3:1: error: table `simulate` is given twice
    3 | [simulate]
      | ^
  put the entries of both under one header
)~"},
      {"a colon for an equals sign",
       R"~(
[simulate]
stop: 1
)~",
       R"~(
scene.toml:2:5: error: expected `=` after the key, found `:`
    2 | stop: 1
      |     ^
  a value follows `=`
)~"},
      {"an array that is not closed",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground", stiffness = 1 }
)~",
       R"~(
scene.toml:2:51: error: expected a value, found `stiffness = 1`
    2 | k1 = { type = "spring", between = ["a", "ground", stiffness = 1 }
      |                                                   ^
  is a closing bracket missing before it?
)~"},
      {"an inline table that is not closed",
       R"~(
[elements]
k1 = { type = "spring", between = ["a", "ground"], stiffness = 1
)~",
       R"~(
scene.toml:2:65: error: the line ends within an inline table
    2 | k1 = { type = "spring", between = ["a", "ground"], stiffness = 1
      |                                                                 ^
  close it with }: an inline table stands on one line; a long one can be a table of its own, [elements.name]
)~"},
      {"a key of very many parts",
       R"~(
a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t.u.v.w.x.y.z.a.b.c.d.e.f.g.h.i.j.k = 1
)~",
       R"~(
scene.toml:1:66: error: a key has at most 32 parts, this one has more
    1 | a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q.r.s.t.u.v.w.x.y.z.a.b.c.d.e.f.g.h.i.j.k = 1
      |                                                                  ^
)~"},
      {"a backslash in a path",
       R"~(
title = "C:\data"
)~",
       R"~(
scene.toml:1:13: error: unknown escape `\d` in a string
    1 | title = "C:\data"
      |             ^
  a backslash is written \\, or the string stands in single quotes
)~"},
      {"a key without a value",
       R"~(
[elements]
k1 = 
)~",
       R"~(
scene.toml:2:6: error: a value is missing after `=`
    2 | k1 = 
      |      ^
)~"},
      {"a number that TOML does not know",
       R"~(
[simulate]
stop = 01
)~",
       R"~(
scene.toml:2:8: error: not valid TOML: decimal integer: leading zeroes are prohibited
    2 | stop = 01
      |        ^
)~"},
      {"a table in braces, and a dotted key that adds to it",
       R"~(
[elements]
"k1" = { type = "spring", between = ["a", "ground"] }
k1.stiffness = 3
)~",
       R"~(
scene.toml:3:1: error: `k1.stiffness` adds to a table that is given whole elsewhere
    3 | k1.stiffness = 3
      | ^
  put it with the other entries of that table
)~"},
      {"a key in quotes after a dotted one of the same name",
       R"~(
[elements]
k1.stiffness = 3
"k1" = { type = "spring", between = ["a", "ground"] }
)~",
       R"~(
scene.toml:3:1: error: key `k1` is given twice
    3 | "k1" = { type = "spring", between = ["a", "ground"] }
      | ^
  a key may stand only once in a table
)~"},
  });
}

}  // namespace rheonet::test::bad_syntax_test
