// Examples of the Modelica Standard Library 4, Mechanics.Translational. Its relative displacement is second - first,
// ours first - second, so the ports are exchanged; its masses have a length L, so the flanges are at s -/+ L/2.
#include <doctest/doctest.h>

#include "tests/references/reference.hpp"

namespace rheonet::test::msl_test {

namespace {

constexpr double accuracy = 1e-8;

}  // namespace

// The nodes are the right ends of the masses, s + 0.5.
TEST_CASE("Modelica Standard Library: Damper") {
  const auto theirs = reference("msl-damper.csv");
  if (!theirs) return;
  const RunTable ours = simulate(R"(
[elements]
wall    = { type = "motion", at = "wall", position = 4.5 }
mass1   = { type = "mass", at = "end1", mass = 1 }
mass2   = { type = "mass", at = "end2", mass = 1 }
mass3   = { type = "mass", at = "end3", mass = 1 }
damper1 = { type = "dashpot", between = ["wall", "end1"], damping = 25 }
damper2 = { type = "dashpot", between = ["wall", "end2"], damping = 25 }
spring2 = { type = "spring", between = ["wall", "end2"], stiffness = 1, rest = 1 }

[elements.both3]
between = ["wall", "end3"]
parallel = [ { type = "spring", stiffness = 1, rest = 1 }, { type = "dashpot", damping = 25 } ]

[nodes]
end1 = { position = 3.5, velocity = 10 }
end2 = { position = 3.5, velocity = 10 }
end3 = { position = 3.5, velocity = 10 }

[simulate]
stop = 1
output = { every = 0.0025 }
)",
                                   accuracy);
  const auto check = [&](const char* column, const char* their_column) {
    check_reference(ours, column, 0, *theirs, their_column, 0.0025, 1e-5);
  };
  check("damper1.displacement", "damper1.s_rel");
  check("damper1.velocity", "damper1.v_rel");
  check("spring2.displacement", "damper2.s_rel");
  check("damper2.velocity", "damper2.v_rel");
  check("both3.displacement", "springDamper3.s_rel");
  check("both3.velocity", "springDamper3.v_rel");
}

TEST_CASE("Modelica Standard Library: Oscillator") {
  const auto theirs = reference("msl-oscillator.csv");
  if (!theirs) return;
  const RunTable ours = simulate(R"(
[elements]
wall    = { type = "motion", at = "wall", position = 1 }
push1   = { type = "force", at = "end1", force = { sine = 1, frequency = 15.9155 } }
push2   = { type = "force", at = "end2", force = { sine = 1, frequency = 15.9155 } }
mass1   = { type = "mass", at = "end1", mass = 1 }
mass2   = { type = "mass", at = "end2", mass = 1 }
spring1 = { type = "spring", between = ["wall", "end1"], stiffness = 1e4, rest = 1 }
spring2 = { type = "spring", between = ["wall", "end2"], stiffness = 1e4, rest = 1 }
damper2 = { type = "dashpot", between = ["wall", "end2"], damping = 10 }

[simulate]
stop = 1
output = { every = 0.0025 }
)",
                                   accuracy);
  const auto check = [&](const char* column, double shift, const char* their_column) {
    check_reference(ours, column, shift, *theirs, their_column, 0.0025, 1e-3);
  };
  check("end1.position", -0.5, "mass1.s");
  check("end1.velocity", 0, "mass1.v");
  check("damper2.displacement", 0, "damper1.s_rel");
  check("damper2.velocity", 0, "damper1.v_rel");
}

// The nodes are the centres of the masses: half their lengths are added to the rest lengths. The second chain is in
// equilibrium and stays.
TEST_CASE("Modelica Standard Library: InitialConditions") {
  const auto theirs = reference("msl-initialconditions.csv");
  if (!theirs) return;
  const RunTable ours = simulate(R"(
[elements]
wall1   = { type = "motion", at = "wall1", position = -1 }
spring1 = { type = "spring", between = ["m1", "wall1"], stiffness = 1e3, rest = "1 + 0.5" }
mass1   = { type = "mass", at = "m1", mass = 1 }
spring2 = { type = "spring", between = ["m2", "m1"], stiffness = 111, rest = "0.5 + 1 + 1" }
damper2 = { type = "dashpot", between = ["m2", "m1"], damping = 1 }
mass2   = { type = "mass", at = "m2", mass = 1 }

wall2   = { type = "motion", at = "wall2", position = 1 }
spring3 = { type = "spring", between = ["m3", "wall2"], stiffness = 1e3, rest = "2 + 1.5" }
mass3   = { type = "mass", at = "m3", mass = 1 }
spring4 = { type = "spring", between = ["m4", "m3"], stiffness = 111, rest = "1.5 + 4 + 2.5" }
damper4 = { type = "dashpot", between = ["m4", "m3"], damping = 1 }
mass4   = { type = "mass", at = "m4", mass = 1 }

[nodes]
m2 = { position = 2.5 }
m3 = { position = 4.5 }
m4 = { position = 12.5 }

[simulate]
stop = 5
output = { every = 0.004 }
)",
                                   accuracy);
  const auto check = [&](const char* column, double shift, const char* their_column) {
    check_reference(ours, column, shift, *theirs, their_column, 0.004, 5e-5);
  };
  check("m1.position", 0, "m1.s");
  check("m1.velocity", 0, "m1.v");
  check("spring2.displacement", -1.5, "sd1.s_rel");
  check("damper2.velocity", 0, "sd1.v_rel");
  check("m3.position", 0, "m3.s");
  check("m3.velocity", 0, "m3.v");
  check("spring4.displacement", -4, "sd2.s_rel");
  check("damper4.velocity", 0, "sd2.v_rel");
}

// The node is the right end of the mass, s + 1.
TEST_CASE("Modelica Standard Library: WhyArrows") {
  const auto theirs = reference("msl-whyarrows.csv");
  if (!theirs) return;
  const RunTable ours = simulate(R"(
[elements]
wall   = { type = "motion", at = "wall", position = -1.9 }
spring = { type = "spring", between = ["end", "wall"], stiffness = 11, rest = 2 }
mass   = { type = "mass", at = "end", mass = 1 }

[nodes]
end = { position = 1 }

[simulate]
stop = 1
output = { every = 0.0025 }
)",
                                   accuracy);
  for (const std::string mass : {"mass1", "inertia2"}) {
    check_reference(ours, "end.position", -1, *theirs, mass + ".s", 0.0025, 1e-5);
    check_reference(ours, "end.velocity", 0, *theirs, mass + ".v", 0.0025, 1e-5);
  }
}

}  // namespace rheonet::test::msl_test
