// At a limit a law has fewer parameters. If a netlist gives one of the others, a note says that it is ignored.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/network/limits.hpp"
#include "core/network/network.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::meaningless_test {

namespace {

/// The notes on ignored parameters, for one element between a mass and ground.
std::vector<std::string> told(const std::string& element, const std::string& more = "") {
  const Scene scene = scene_of("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n" + element + "\n[simulate]\nstop = 1\n" + more);
  std::vector<std::string> notes = build_network(scene).notes;
  std::erase_if(notes, [](const std::string& note) { return note.find("nothing to") == std::string::npos; });
  return notes;
}

std::string element(const std::string& values) { return "e = { between = [\"a\", \"ground\"], " + values + " }"; }

using Notes = std::vector<std::string>;

}  // namespace

TEST_CASE("what a limit makes meaningless, and the netlist gives, is told; what is not given is not") {
  const struct {
    const char *values, *given, *limit;  ///< No note if `given` is empty.
  } cases[] = {
      {R"(type = "spring", stiffness = "inf", f0 = 3)", "`e.f0`", "rigid link (stiffness = inf)"},
      {R"(type = "spring", stiffness = 1e9, f0 = 3)", "", ""},
      {R"(type = "spring", stiffness = "inf")", "", ""},
      {R"(type = "spring", stiffness = "inf", rest = 0, f0 = 3)", "`e.rest`, `e.f0`", "rigid link (stiffness = inf)"},
      {R"(type = "dashpot", damping = "inf", flow_index = 0.5)", "`e.flow_index`", "rigid link (damping = inf)"},
      {R"(type = "slider", coulomb = 3, breakaway = "inf")", "`e.coulomb`", "rigid link (breakaway = inf)"},
      {R"(type = "slider", coulomb = "inf")", "", ""},
      {R"(type = "sfm", stiffness = "inf", coulomb = 2, exponent = 1, f0 = 0.4)", "`e.exponent`, `e.f0`", "`slider` (stiffness = inf)"},
      // A spring keeps the start force; without a bound there is no shape.
      {R"(type = "sfm", stiffness = 2, coulomb = "inf", exponent = 2, f0 = 0.4)", "`e.exponent`", "`spring` (coulomb = inf)"},
      {R"(type = "vfm", stiffness = "inf", damping = 2, f0 = 0.4)", "`e.f0`", "`dashpot` (stiffness = inf)"},
      {R"(type = "cfm", stiffness = 2, coulomb = 3, damping = "inf", exponent = 2, f0 = 0.4)", "", ""},
      {R"(type = "cfm", stiffness = "inf", coulomb = 3, damping = "inf", exponent = 2)", "`e.exponent`", "`slider` (damping = inf)"},
      {R"(type = "davidenkov", stiffness = 2, coulomb = 3, exponent = "inf", f0 = 1)", "", ""},
  };
  for (const auto& [values, given, limit] : cases) {
    CAPTURE(values);
    const std::string several = given, to = std::string(" to a ") + limit + ", and ";
    Notes expected;
    if (several.find(',') != std::string::npos) expected = {several + " mean nothing" + to + "are left out"};
    else if (!several.empty()) expected = {several + " means nothing" + to + "is left out"};
    CHECK_EQ(told(element(values)), expected);
  }
}

TEST_CASE("many that are left out for one reason are told at once, also where an effect is left out") {
  const std::string chain = "c = { type = \"spring\", between = [\"a\", \"ground\"], stiffness = \"inf\", f0 = 3, repeat = { count = 7, arrange = \"series\" } }";
  CHECK_EQ(told(chain),
           Notes{"`c.0.f0`, `c.1.f0`, `c.2.f0`, `c.3.f0`, `c.4.f0` and 2 more mean nothing to a rigid link (stiffness = inf), and are left out"});
  CHECK_EQ(told(element("type = \"spring\", stiffness = 8, f0 = 3"), "[effects]\nwithout = [\"elasticity\"]\n"),
           Notes{"`e.f0` means nothing to a rigid link (without what the scene leaves out), and is left out"});
}

// It says where nodes start, whatever the element has become.
TEST_CASE("a start displacement means the same at a limit") {
  for (const char* stiffness : {"\"inf\"", "0", "3.1"}) {
    CAPTURE(stiffness);
    const RunTable run = simulate(std::string("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                                                "e = { type = \"spring\", between = [\"a\", \"b\"], d0 = 0.31, stiffness = ") +
                                    stiffness + " }\nk = { type = \"spring\", between = [\"b\", \"ground\"], stiffness = 2 }\n"
                                                "mb = { type = \"mass\", at = \"b\", mass = 1 }\n"
                                                "[nodes]\nb = { position = 0.2 }\n[simulate]\nstop = 1\n");
    CHECK_EQ(run["a.position"].front(), doctest::Approx(0.51).epsilon(1e-12));
    CHECK_EQ(run["e.displacement"].front(), doctest::Approx(0.31).epsilon(1e-12));
  }
}

}  // namespace rheonet::test::meaningless_test
