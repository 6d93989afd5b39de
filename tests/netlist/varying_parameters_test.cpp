// Parameters that may be signals, coefficients, and parameters that exclude each other: valid uses, and the messages on misuse.
#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::varying_parameters_test {

namespace {

std::string scene(const std::string& slider, const std::string& more = "") {
  return "[elements]\nm1 = { type = \"mass\", at = \"a\", mass = \"2 kg\" }\nk1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"5 N/m\" }\n" +
         more + "s1 = { type = \"slider\", between = [\"a\", \"ground\"], " + slider + " }\n[nodes]\na = { velocity = \"1 m/s\" }\n[simulate]\nstop = 1\n";
}

/// The message says this, points there (line:column), and has this advice.
void check_message(const std::string& found, const std::string& place, const std::string& says, const std::string& advice) {
  CAPTURE(found);
  CHECK(found.starts_with("scene.toml:" + place + ": error: " + says + "\n"));
  CHECK((advice.empty() ? found.ends_with("^\n") : found.ends_with("^\n  " + advice + "\n")));
}

void check_refused(const std::string& slider, const std::string& place, const std::string& says, const std::string& advice = "", const std::string& more = "") {
  check_message(refusal(scene(slider, more)), place, says, advice);
}

const std::string g = "g1 = { type = \"gain\", in = \"a.velocity\", gain = \"3 N*s/m\" }\n";
const std::string number = "g1 = { type = \"gain\", in = \"a.velocity\", gain = \"3 s/m\" }\n";

}  // namespace

TEST_CASE("sliders: what may vary, and what multiplies what") {
  for (const char* slider : {"coulomb = \"2 N\"", "coulomb = { ramp = \"2 N/s\" }", "coulomb = 0.3, normal = \"7 N\"", "coulomb = \"30 %\", normal = \"7 N\"",
                             "coulomb = 0.3, breakaway = 0.4, normal = { sine = \"7 N\", frequency = \"2 Hz\" }",
                             "coulomb = { table = [[0, 0.1], [1, 0.3]] }, normal = { sine = \"7 N\", frequency = \"2 Hz\" }, peak = 1.2",
                             "coulomb = \"2 N\", breakaway = { ramp = \"2 N/s\", offset = \"3 N\" }", "coulomb = 0.3, normal = \"0 N\"", "coulomb = \"2 N\", peak = 1"}) {
    CAPTURE(slider);
    CHECK_EQ(refusal(scene(slider)), "");
  }
  CHECK_EQ(refusal(scene("coulomb = 0.3, normal = { block = \"g1\" }", g)), "");
  CHECK_EQ(refusal(scene("coulomb = 0.3, normal = { block = \"-g1\" }", g)), "");
  CHECK_EQ(refusal(scene("coulomb = { block = \"g1\" }", g)), "");
  CHECK_EQ(refusal(scene("coulomb = { block = \"g1\" }, normal = \"3 N\"", number)), "");
}

TEST_CASE("sliders: messages for parameters that do not fit") {
  const std::string of_normal = "`coulomb` (which multiplies `normal`)";
  const std::string infinite = "\"inf\" is for laws that become another one there, and this one does not; a value large beside those around it comes close";
  const std::string signals = "what may vary in time is `coulomb`, `breakaway` and `normal` of a `slider`";
  const std::string from_block = "a signal comes from a block: a `gain` makes one of a quantity of the network";
  check_refused("coulomb = \"2 N\", normal = \"7 N\"", "4:62", of_normal + ": expected a number without a unit, found a force (N)");
  check_refused("coulomb = { ramp = \"2 N/s\" }, normal = \"7 N\"", "4:71",
                "`ramp`: expected the rise of `coulomb` per second (1/s), found a quantity in kg*m*s^-3");
  check_refused("coulomb = 0.3, normal = \"7 kg\"", "4:76", "`normal`: expected a force (N), found a mass (kg)",
                "there is a mass in its unit where a force is needed: `kgf`, `lbf` and `N` are forces; a mass times `9.81 m/s^2` is its weight");
  check_refused("coulomb = 0.3, normal = \"-7 N\"", "4:76", "`normal` must be at least 0, but is -7 N");
  check_refused("coulomb = -0.3, normal = \"7 N\"", "4:62", of_normal + " must be at least 0, but is -0.3");
  check_refused("coulomb = \"inf\", normal = \"7 N\"", "4:62", of_normal + " must be finite, but is infinite", infinite);
  check_refused("coulomb = 0.3, normal = \"inf\"", "4:76", "`normal` must be finite, but is infinite", infinite);
  check_refused("coulomb = \"2 N\", peak = 0.9", "4:76", "`peak` must be at least 1, but is 0.9");
  check_refused("coulomb = \"2 N\", peak = \"3 N\"", "4:76", "`peak`: expected a number without a unit, found a force (N)");
  check_refused("coulomb = \"2 N\", peak = { ramp = 1 }", "4:76", "`peak` is constant in time, but is a table", signals);
  check_refused("coulomb = \"2 N\", breakaway = \"3 N\", peak = 1.2", "4:88", "a `slider` has both `breakaway` and `peak`", "only one of them can be given");
  check_refused("coulomb = { ramp = 1 }, peak = 1.2, breakaway = { ramp = 2 }", "4:88", "a `slider` has both `peak` and `breakaway`", "only one of them can be given");
  check_refused("coulomb = 0.3, breakaway = 0.2, normal = \"7 N\"", "4:79",
                "`breakaway` must be at least `coulomb`: under a force between the two the slider could neither stick nor slip");
  check_refused("coulomb = \"2 N\", breakaway = { ramp = \"2 m/s\" }", "4:90",
                "`ramp`: expected the rise of `breakaway` per second (N/s), found a velocity (m/s)");
  check_refused("coulomb = 0.3, normal = { block = \"g1\" }", "5:86", "`normal` from block `g1`: expected a force (N), found a pure number", "", number);
  check_refused("coulomb = { block = \"g1\" }", "5:72", "`coulomb` from block `g1`: expected a force (N), found a pure number", "", number);
  check_refused("coulomb = { block = \"g1\" }, normal = \"7 N\"", "5:72",
                of_normal + " from block `g1`: expected a number without a unit, found a force (N)", "", g);
  check_refused("coulomb = 0.3, normal = { block = \"k1.force\" }", "4:86", "no block is called `k1.force`", from_block);
  check_refused("normal = \"7 N\"", "4:1", "a `slider` needs `coulomb`", "a number without a unit, which multiplies `normal`");
}

TEST_CASE("signals for parameters that take none, and parameters of an element without any") {
  const auto with = [](const std::string& element) {
    return refusal("[elements]\nm1 = { type = \"mass\", at = \"a\", mass = 2 }\n" + element + "\n[simulate]\nstop = 1\n");
  };
  check_message(with("m2 = { type = \"mass\", at = \"a\", mass = { ramp = 1 } }"), "3:40", "`mass` is constant in time, but is a table",
                "no parameter of a `mass` may vary in time; types with such parameters are `cfm`, `dashpot`, `force`, `generator`, `law`, `motion`, `sfm`, `slider`, `spring`, `stop` and `vfm`");
  check_message(with("f1 = { type = \"freewheel\", between = [\"a\", \"ground\"], coulomb = 1 }"), "3:55", "unknown key `coulomb` of a `freewheel`",
                "its keys are `type`, `between`, `domain` and `repeat`");
  check_message(with("f1 = { type = \"freewheel\", at = \"a\" }"), "3:28", "`f1` is between two nodes, not `at` one", "between = [\"a\", \"ground\"]");
}

}  // namespace rheonet::test::varying_parameters_test
