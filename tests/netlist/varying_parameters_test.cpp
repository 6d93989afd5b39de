// Parameters that may be signals, coefficients, and parameters that exclude each other: what is accepted, and the messages of misuse.
#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

namespace {

std::string scene(const std::string& slider, const std::string& more = "") {
  return "[elements]\nm1 = { type = \"mass\", at = \"a\", mass = \"2 kg\" }\nk1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"5 N/m\" }\n" +
         more + "s1 = { type = \"slider\", between = [\"a\", \"ground\"], " + slider + " }\n[nodes]\na = { velocity = \"1 m/s\" }\n[simulate]\nstop = 1\n";
}

void check_refused(const std::string& slider, const std::string& message, const std::string& more = "") {
  CAPTURE(slider);
  CHECK_EQ(refusal(scene(slider, more)), message);
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
  check_refused("coulomb = \"2 N\", normal = \"7 N\"", "");
  check_refused("coulomb = { ramp = \"2 N/s\" }, normal = \"7 N\"", "");
  check_refused("coulomb = 0.3, normal = \"7 kg\"", "");
  check_refused("coulomb = 0.3, normal = \"-7 N\"", "");
  check_refused("coulomb = -0.3, normal = \"7 N\"", "");
  check_refused("coulomb = \"inf\", normal = \"7 N\"", "");
  check_refused("coulomb = 0.3, normal = \"inf\"", "");
  check_refused("coulomb = \"2 N\", peak = 0.9", "");
  check_refused("coulomb = \"2 N\", peak = \"3 N\"", "");
  check_refused("coulomb = \"2 N\", peak = { ramp = 1 }", "");
  check_refused("coulomb = \"2 N\", breakaway = \"3 N\", peak = 1.2", "");
  check_refused("coulomb = \"2 N\", breakaway = \"2 N\", peak = 1.2", "");
  check_refused("coulomb = 0.3, breakaway = 0.2, normal = \"7 N\"", "");
  check_refused("coulomb = \"2 N\", breakaway = { ramp = \"2 m/s\" }", "");
  check_refused("coulomb = 0.3, normal = { block = \"g1\" }", "", number);
  check_refused("coulomb = { block = \"g1\" }", "", number);
  check_refused("coulomb = { block = \"g1\" }, normal = \"7 N\"", "", g);
  check_refused("coulomb = 0.3, normal = { block = \"k1\" }", "");
  check_refused("coulomb = 0.3, normal = { block = \"k1.force\" }", "");
  check_refused("normal = \"7 N\"", "");
}

TEST_CASE("signals for parameters that take none") {
  const auto with = [](const std::string& element) {
    return refusal("[elements]\nm1 = { type = \"mass\", at = \"a\", mass = 2 }\n" + element + "\n[simulate]\nstop = 1\n");
  };
  CHECK_EQ(with("k1 = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = { ramp = 1 } }"), "");
  CHECK_EQ(with("f1 = { type = \"freewheel\", between = [\"a\", \"ground\"], coulomb = 1 }"), "");
  CHECK_EQ(with("f1 = { type = \"freewheel\", at = \"a\" }"), "");
}

}  // namespace rheonet::test
