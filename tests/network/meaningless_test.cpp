// At a limit a law has fewer parameters: what a netlist gives of the others is told to be left out, not dropped in silence.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/network/limits.hpp"
#include "core/network/network.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

namespace {

/// The notes that speak of what is left out, of one element between a mass and the ground.
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
  CHECK_EQ(told(element("type = \"spring\", stiffness = \"inf\", f0 = 3")),
           Notes{"`e.f0` means nothing to a rigid link (stiffness = inf), and is left out"});
  CHECK_EQ(told(element("type = \"spring\", stiffness = 1e9, f0 = 3")), Notes{});
  CHECK_EQ(told(element("type = \"spring\", stiffness = \"inf\"")), Notes{});
  CHECK_EQ(told(element("type = \"spring\", stiffness = \"inf\", rest = 0, f0 = 3")),
           Notes{"`e.rest`, `e.f0` mean nothing to a rigid link (stiffness = inf), and are left out"});
  CHECK_EQ(told(element("type = \"dashpot\", damping = \"inf\", flow_index = 0.5")),
           Notes{"`e.flow_index` means nothing to a rigid link (damping = inf), and is left out"});
  CHECK_EQ(told(element("type = \"slider\", coulomb = 3, breakaway = \"inf\"")),
           Notes{"`e.coulomb` means nothing to a rigid link (breakaway = inf), and is left out"});
  CHECK_EQ(told(element("type = \"slider\", coulomb = \"inf\"")), Notes{});
  CHECK_EQ(told(element("type = \"sfm\", stiffness = \"inf\", coulomb = 2, exponent = 1, f0 = 0.4")),
           Notes{"`e.exponent`, `e.f0` mean nothing to a `slider` (stiffness = inf), and are left out"});
  // A spring keeps the start force; without a bound there is no shape.
  CHECK_EQ(told(element("type = \"sfm\", stiffness = 2, coulomb = \"inf\", exponent = 2, f0 = 0.4")),
           Notes{"`e.exponent` means nothing to a `spring` (coulomb = inf), and is left out"});
  CHECK_EQ(told(element("type = \"vfm\", stiffness = \"inf\", damping = 2, f0 = 0.4")),
           Notes{"`e.f0` means nothing to a `dashpot` (stiffness = inf), and is left out"});
  CHECK_EQ(told(element("type = \"cfm\", stiffness = 2, coulomb = 3, damping = \"inf\", exponent = 2, f0 = 0.4")), Notes{});
  CHECK_EQ(told(element("type = \"cfm\", stiffness = \"inf\", coulomb = 3, damping = \"inf\", exponent = 2")),
           Notes{"`e.exponent` means nothing to a `slider` (damping = inf), and is left out"});
  CHECK_EQ(told(element("type = \"davidenkov\", stiffness = 2, coulomb = 3, exponent = \"inf\", f0 = 1")), Notes{});
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
    const Trajectory run = simulate(std::string("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\n"
                                                "e = { type = \"spring\", between = [\"a\", \"b\"], d0 = 0.31, stiffness = ") +
                                    stiffness + " }\nk = { type = \"spring\", between = [\"b\", \"ground\"], stiffness = 2 }\n"
                                                "mb = { type = \"mass\", at = \"b\", mass = 1 }\n"
                                                "[nodes]\nb = { position = 0.2 }\n[simulate]\nstop = 1\n");
    CHECK_EQ(run["a.position"].front(), doctest::Approx(0.51).epsilon(1e-12));
    CHECK_EQ(run["e.displacement"].front(), doctest::Approx(0.31).epsilon(1e-12));
  }
}

}  // namespace rheonet::test
