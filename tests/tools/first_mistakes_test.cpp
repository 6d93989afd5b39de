#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::first_mistakes_test {

namespace {

struct Mistake {
  std::string line;  ///< of [elements]
  std::string place, message, remedy;
};

}  // namespace

TEST_CASE("what beginners write, or users of other tools: each message says what would mend it") {
  const std::vector<Mistake> mistakes{
      {"m = { type = 'mass', at = 'a', mass = 1, velocity = 2 }", "2:42", "unknown key `velocity` of a `mass`", "`velocity` belongs in [nodes], as a start value of a node"},
      {"f = { type = 'force', at = 'a', force = { pulse = 1, width = 1, period = 2 } }", "2:65", "unknown key `period`", "`frequency` is 1/period"},
      {"f = { type = 'force', at = ['a', 'b'], force = 1 }", "2:28", "the name of a node must be a string, but is an array", "one node: at = \"cart\""},
      {"f = { type = 'force', at = 'a', force = '2*sin(t)' }", "2:41", "there is no parameter `t`", "the output of a `function`, { block = \"f\" }"},
      {"s = { type = 'spring', between = ['a', 'b'], stiffness = \u201C1 N/m\u201D }", "2:58", "is not a value", "quotes are straight: \"1 N/m\""},
      {"s = { type = 'spring', between = ['a', 'b'], stiffness = '1,000 N/m' }", "2:60", "an expression has one value", "a number has no comma: 1000 or 1.5"},
      {"s = { type = 'spring', between = ['a', 'b'], stiffness = 5. }", "2:58", "`5.` is not a number", "a decimal point stands between digits: 5.0, 0.5"},
      {"s = { type = 'spring', between = ['a', 'b'], stiffness = .5 }", "2:58", "`.5` is not a number", "a decimal point stands between digits: 5.0, 0.5"},
      {"s = { type = 'spring', between = ['a', 'b'] stiffness = 5 }", "2:45", "unexpected `stiffness = 5` after a value", "a comma is missing before it"},
      {"// the spring", "2:1", "unexpected `// the spring`", "a comment begins with `#`"},
      {"d\u00E4mpfer = 3", "2:2", "expected `=` after the key", "a key is made of a to z, A to Z, 0 to 9"},
      {"my spring = 3", "2:4", "expected `=` after the key", "a name has no spaces"},
      {"s = { type: 'spring' }", "2:11", "expected `=` after the key", "a value follows `=`"},
      {"g = { type = 'gear', between = ['a', 'b'], ratio = '5:1' }", "2:54", "unexpected `:`", "a ratio is one number: 5, not 5:1"},
      {"g = { type = 'gear', between = ['a', 'b'], ratio = 5, efficiency = 90 }", "2:68", "`efficiency` must be at most 1, but is 90", "90 % is 0.9, or \"90 %\""},
      {"g = { type = 'gap', between = ['a', 'b'] }", "2:14", "unknown element type `gap`", "it is called `stop` here"},
      {"g = { type = 'GearBox', between = ['a', 'b'] }", "2:14", "unknown element type `GearBox`", "it is called `gear` here"},
      {"g = { type = 'motor', at = 'a' }", "2:14", "unknown element type `motor`", "it is called `force` or `motion` here, `torque` in rotation"},
      {"g = { type = 'drum', between = ['a', 'b'] }", "2:14", "unknown element type `drum`", "the types that stand between nodes are `cfm`, `dashpot`"},
      {"g = { type = 'kelvin_voigt', between = ['a', 'b'] }", "2:14", "unknown element type `kelvin_voigt`", "`kelvin-voigt` is in the library: include = [\"library/rheology.toml\"]"},
      {"g = { type = 'lugre', between = ['a', 'b'] }", "2:14", "unknown element type `lugre`", "`lugre` is in the library: include = [\"library/friction.toml\"]"},
      {"[elements.d]\ntype = 'dashpot'\nbetween = ['a', 'b']\ndamping = 1\ns = { type = 'spring', between = ['a', 'b'], stiffness = 1 }", "6:1", "unknown key `s` of a `dashpot`", "or write [elements.s]"},
  };
  const Folder folder;
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.line);
    folder.write("scene.toml", "[elements]\n" + mistake.line + "\n[simulate]\nstop = 1\n");
    const std::string said = folder.shell("rheonet check scene.toml", 2).err;
    CAPTURE(said);
    CHECK(contains(said, "scene.toml:" + mistake.place + ": error: "));
    CHECK(contains(said, mistake.message));
    CHECK(contains(said, mistake.remedy));
  }
  folder.write("scene.toml", "[elements]\nm = { type = 'inertia', at = 'a', inertia = 1 }\n[nodes]\na = { angle = 1 }\n[simulate]\nstop = 1\n");
  CHECK(contains(folder.shell("rheonet check scene.toml", 2).err, "`angle` is called `position` here, in rotation too"));
  folder.write("scene.toml", "[[elements]]\ns = 1\n[simulate]\nstop = 1\n");
  CHECK(contains(folder.shell("rheonet check scene.toml", 2).err, "the header of a table has single brackets, as [elements]"));
  folder.write("scene.toml", "include = ['library/rheology']\n[simulate]\nstop = 1\n");
  CHECK(contains(folder.shell("rheonet check scene.toml", 2).err, "is its name `library/rheology.toml`?"));
  folder.write("scene.toml", "[elements]\ns = { type = 'spring', between = ['a', 'ground'], stiffness = 1 }\n[simulate]\nstop = 1\nrecord = ['s.speed']\n");
  CHECK(contains(folder.shell("rheonet check scene.toml", 2).err, "did you mean `s.velocity`?"));
}

TEST_CASE("explain: the force of a gear between masses follows from their acceleration") {
  const Folder folder;
  folder.write("scene.toml", R"(
[elements]
a = { type = "mass", at = "x", mass = 1 }
b = { type = "mass", at = "y", mass = 2 }
g = { type = "lever", between = ["x", "y"], ratio = 3 }
f = { type = "force", at = "x", force = 1 }
[simulate]
stop = 1
)");
  CHECK(contains(folder.shell("rheonet explain scene.toml", 0).out, "index 2 as wired, 0 as solved; what joins the masses at `x`, `y`"));
}

}  // namespace rheonet::test::first_mistakes_test
