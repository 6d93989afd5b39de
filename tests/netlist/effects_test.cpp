#include <doctest/doctest.h>

#include "core/network/component.hpp"
#include "tests/netlist/reading.hpp"

namespace rheonet::test::effects_test {

namespace {

const std::string two_oils = R"([elements]
drive = { type = "motion", at = "drum", velocity = 1 }
oil.between = ["drum", "ground"]
oil.parallel = [ { name = "thick", type = "vfm", damping = 2, stiffness = 30 }, { name = "thin", type = "vfm", damping = 1, stiffness = 20 } ]
rotor = { type = "mass", at = "rotor", mass = 3 }
shaft = { type = "spring", between = ["drum", "rotor"], stiffness = 40 }
)";

ReadResult read_with(const std::string& table, ReadOptions options = {}) {
  return read_scene_text(two_oils + table + "\n[simulate]\nstop = 1\n", "scene.toml", "no-such-folder", declarations(), options);
}

ReadOptions without(std::vector<std::string> effects) {
  ReadOptions options;
  options.without = std::move(effects);
  return options;
}

ReadOptions only(std::vector<std::string> effects) {
  ReadOptions options;
  options.only = std::move(effects);
  return options;
}

/// "inertia; elasticity of `oil`"
std::string left_out(const std::string& table, ReadOptions options = {}) {
  const ReadResult result = read_with(table, options);
  REQUIRE(result.scene);
  std::string text;
  for (const EffectLeftOut& out : result.scene->without) text += (text.empty() ? "" : "; ") + out.in_words();
  return text;
}

}  // namespace

TEST_CASE("[effects] says what is left out, everywhere or of some elements") {
  CHECK_EQ(left_out(""), "");
  CHECK_EQ(left_out("[effects]\nwithout = []"), "");
  CHECK_EQ(left_out("[effects]\nwithout = [\"inertia\", \"dry friction\", \"elasticity:oil\"]"),
           "inertia; dry friction; elasticity of `oil`");
  CHECK_EQ(left_out("[effects]\nonly = [\"viscosity\", \"elasticity\"]"), "inertia; dry friction; contact; delay; feedback");
}

TEST_CASE("what stays of an effect in some elements is left out of all others") {
  const std::string others = "inertia; elasticity of `drive`; elasticity of `rotor`; elasticity of `shaft`; dry friction; contact; delay; feedback";
  CHECK_EQ(left_out("[effects]\nonly = [\"viscosity\", \"elasticity:oil\"]"), others);
}

TEST_CASE("the command line leaves out more than the file, or all but what it names") {
  const std::string table = "[effects]\nwithout = [\"inertia\"]";
  CHECK_EQ(left_out(table, without({"delay", "elasticity:shaft"})), "inertia; delay; elasticity of `shaft`");
  CHECK_EQ(left_out(table, only({"inertia", "elasticity", "viscosity", "feedback"})), "dry friction; contact; delay");
  CHECK_EQ(left_out(table, only({})), "inertia; elasticity; viscosity; dry friction; contact; delay; feedback");
  ReadOptions set;
  set.overrides = {"effects.without=[\"viscosity\"]"};
  CHECK_EQ(left_out(table, set), "viscosity");
}

TEST_CASE("an effect concerns an element by its path, and what is in an assembly by that of the assembly") {
  const EffectLeftOut out{Effect::elasticity, "oil"};
  CHECK(out.concerns("oil"));
  CHECK(out.concerns("oil.thick"));
  CHECK_FALSE(out.concerns("oil2"));
  CHECK_FALSE(out.concerns("oi"));
  CHECK_FALSE(out.concerns("gap.oil"));
  CHECK(EffectLeftOut{Effect::elasticity}.concerns("gap.oil"));
}

TEST_CASE("what names no effect, or no element, is a mistake at its place") {
  CHECK_EQ(test::messages(read_with("[effects]\nwithout = [\"inertai\"]")),
           "scene.toml:8:13: error: there is no effect `inertai`\n    8 | without = [\"inertai\"]\n      |             ^\n"
           "  did you mean `inertia`?\n");
  CHECK_EQ(test::messages(read_with("[effects]\nwithout = [\"elasticity:oli\"]")),
           "scene.toml:8:24: error: nothing is called `oli`\n    8 | without = [\"elasticity:oli\"]\n      |                        ^\n"
           "  did you mean `oil`?\n");
  CHECK(test::contains(test::messages(read_with("", without({"friction of oil"}))), "command line: error: there is no effect `friction of oil`"));
  CHECK(test::contains(test::messages(read_with("[effects]\nwithout = 3")), "`without` must be an array"));
  CHECK(test::contains(test::messages(read_with("[effects]\nwihout = []")), "did you mean `without`?"));
  CHECK(test::contains(test::messages(read_with("[effects]\nwithout = []\nonly = []")), "[effects] has both `without` and `only`"));
}

TEST_CASE("to leave out an effect that nothing has is told; to keep one is not") {
  const auto told = [](const std::string& table, ReadOptions options = {}) { return test::messages(read_with(table, options)); };
  CHECK_EQ(told("[effects]\nwithout = [\"dry friction\"]"),
           "scene.toml:8:13: warning: nothing in the scene has dry friction: to leave it out changes nothing\n    8 | without = [\"dry friction\"]\n"
           "      |             ^\n  its effects are `inertia`, `elasticity` and `viscosity`\n");
  CHECK_EQ(told("", without({"delay"})),
           "command line: warning: nothing in the scene has delay: to leave it out changes nothing\n      | --without delay\n      |           ^\n"
           "  its effects are `inertia`, `elasticity` and `viscosity`\n");
  CHECK(test::contains(told("", without({"inertia:oil"})), "warning: nothing in `oil` has inertia"));
  CHECK(test::contains(told("", without({"feedback"})), "warning: nothing in the scene has feedback"));
  CHECK_EQ(told("", without({"inertia", "elasticity:oil", "viscosity"})), "");
  CHECK_EQ(told("", only({"inertia", "delay"})), "");
}

}  // namespace rheonet::test::effects_test
