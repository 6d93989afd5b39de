// Consistent initial states, and jumps that propagate through a network within one instant.

#include <doctest/doctest.h>

#include <cmath>

#include "tests/dae/started.hpp"
#include "tests/support/solid_friction.hpp"

namespace rheonet::test::start_test {

namespace {

constexpr double k = 137.3, k2 = 71.9, B = 2.71, B2 = 0.83, m = 0.47, dx = 0.0193, F = 3.7;
constexpr double digits = 1e-12;

Signal step(double height) { return Signal(Signal::Step{height, 0, 0}); }

}  // namespace

TEST_CASE("a step of position over Maxwell's element stretches the spring, either way round") {
  for (const bool spring_first : {true, false}) {
    CAPTURE(spring_first);
    for (const double sign : {1.0, -1.0}) {
      SceneBuilder b;
      b.motion("drive", "end", "position", step(sign * dx));
      if (spring_first) {
        b.between("k", "spring", "end", "mid", {{"stiffness", k}});
        b.between("c", "dashpot", "mid", "ground", {{"damping", B}});
      } else {
        b.between("c", "dashpot", "end", "mid", {{"damping", B}});
        b.between("k", "spring", "mid", "ground", {{"stiffness", k}});
      }
      const Started s(b);
      CHECK_EQ(s.deflection("k"), exactly(sign * dx));
      CHECK_EQ(s.force("k"), exactly(sign * k * dx));
      CHECK_EQ(s.force("c"), exactly(sign * k * dx));
      CHECK_EQ(s.reaction("end"), exactly(sign * k * dx));
      // It relaxes from there: p' = -f/B.
      CHECK_EQ(s.deflection_rate("k"), exactly(-sign * k * dx / B));
      CHECK_EQ(s.velocity("mid"), exactly((spring_first ? 1 : -1) * sign * k * dx / B));
      CHECK_EQ(s.position("mid"), exactly(spring_first ? 0 : sign * dx));
      CHECK(s.jump.notes.empty());
      CHECK_EQ(s.jump.heat, 0);
    }
  }
}

TEST_CASE("a step of position over Zener's element meets both springs") {
  SceneBuilder b;
  b.motion("drive", "end", "position", step(dx));
  b.between("k", "spring", "end", "ground", {{"stiffness", k}});
  b.between("k2", "spring", "mid", "end", {{"stiffness", k2}});
  b.between("c", "dashpot", "mid", "ground", {{"damping", B}});
  const Started s(b);
  CHECK_EQ(s.force("k"), exactly(k * dx));
  CHECK_EQ(s.force("k2"), exactly(-k2 * dx));
  CHECK_EQ(s.reaction("end"), exactly((k + k2) * dx));
  CHECK_EQ(s.velocity("mid"), exactly(k2 * dx / B));
}

TEST_CASE("a step of position over springs in series divides by their compliances") {
  SceneBuilder b;
  b.motion("drive", "end", "position", step(dx));
  b.between("k", "spring", "end", "mid", {{"stiffness", k}});
  b.between("k2", "spring", "mid", "ground", {{"stiffness", k2}});
  const Started s(b);
  CHECK_EQ(s.deflection("k"), exactly(dx * k2 / (k + k2)));
  CHECK_EQ(s.deflection("k2"), exactly(dx * k / (k + k2)));
  CHECK_EQ(s.position("mid"), exactly(dx * k / (k + k2)));
}

TEST_CASE("a step of position over a dashpot gives a mass the momentum B dx") {
  constexpr double v0 = 0.37;
  SceneBuilder b;
  b.motion("drive", "end", "position", step(dx));
  b.between("c", "dashpot", "end", "mass", {{"damping", B}});
  b.at("m", "mass", "mass", {{"mass", m}});
  b.start("mass", 0.11, v0);
  b.between("k", "spring", "mass", "ground", {{"stiffness", k}});
  const Started s(b);
  CHECK_EQ(s.velocity("mass"), exactly(v0 + B * dx / m));
  CHECK_EQ(s.position("mass"), exactly(0.11));
  CHECK_EQ(s.deflection("k"), exactly(0.11));
  CHECK_EQ(s.force("c"), exactly(-B * (v0 + B * dx / m)));
  CHECK_EQ(s.acceleration("mass"), exactly((-B * (v0 + B * dx / m) - k * 0.11) / m));
  REQUIRE_EQ(s.jump.notes.size(), 1);
  CHECK_EQ(
      s.jump.notes[0],
      "at t = 0 s a step in position moves dashpot `c` by 0.0193 m in no time: its force at such a step is an impulse, which no "
      "row shows and the energy account leaves out");
}

TEST_CASE("massless nodes between dashpots go where the impulses balance") {
  SceneBuilder b;
  b.motion("drive", "end", "position", step(-dx));
  b.between("c", "dashpot", "mid", "end", {{"damping", B}});
  b.between("c2", "dashpot", "mid", "mass", {{"damping", B2}});
  b.between("k", "spring", "mid", "ground", {{"stiffness", k}});
  b.at("m", "mass", "mass", {{"mass", m}});
  const Started s(b);
  // Springs do not resist within an instant.
  const double share = B / (B + B2);
  CHECK_EQ(s.position("mid"), exactly(-share * dx));
  CHECK_EQ(s.deflection("k"), exactly(-share * dx));
  CHECK_EQ(s.velocity("mass"), exactly(-B2 * share * dx / m));
  CHECK_EQ(s.jump.notes.size(), 2);
  // v of the massless node: B v + B2 (v - v_mass) + k x = 0
  const double v_mass = -B2 * share * dx / m, v = (B2 * v_mass + k * share * dx) / (B + B2);
  CHECK_EQ(s.velocity("mid"), exactly(v));
}

TEST_CASE("a step of force stretches what floats at once, and accelerates what is heavy") {
  SceneBuilder b;
  b.force("push", "n1", step(F));
  b.between("k", "spring", "n2", "n1", {{"stiffness", k}});
  b.between("k2", "spring", "n2", "mass", {{"stiffness", k2}});
  b.at("m", "mass", "mass", {{"mass", m}});
  b.between("c", "dashpot", "mass", "ground", {{"damping", B}});
  b.start("mass", 0, -0.23);
  const Started s(b);
  CHECK_EQ(s.force("k"), exactly(-F));
  CHECK_EQ(s.force("k2"), exactly(F));
  CHECK_EQ(s.position("n1"), exactly(F / k + F / k2));
  CHECK_EQ(s.acceleration("mass"), exactly((F + B * 0.23) / m));
  // The force stays: what floats goes along with the mass.
  CHECK_EQ(s.velocity("n1"), exactly(-0.23));
  CHECK_EQ(s.velocity("n2"), exactly(-0.23));
}

TEST_CASE("nodes that float in one group: their balances, and the velocity of the whole") {
  constexpr double v = 0.31, push = 1.9;
  SceneBuilder b;
  b.motion("drive", "end", "velocity", Signal(Signal::Constant{v}));
  b.between("k", "spring", "end", "n1", {{"stiffness", k}});
  b.between("c", "dashpot", "n1", "n2", {{"damping", B}});
  b.between("k2", "spring", "n2", "ground", {{"stiffness", k2}});
  b.force("push", "n1", Signal(Signal::Constant{push}));
  const Started s(b);
  // Before anything stretches the force goes over the springs: k p1 = F_1 - ..., one balance for both nodes.
  const double p1 = s.deflection("k"), p2 = s.deflection("k2");
  CHECK_EQ(-k * p1 + k2 * p2, exactly(push));
  CHECK_EQ(s.force("c"), exactly(k * p1 + push));
  CHECK_EQ(s.velocity("n1") - s.velocity("n2"), exactly(s.force("c") / B));
  // Differentiated: k (v - v1) = k2 v2.
  CHECK_EQ(k * (v - s.velocity("n1")), exactly(k2 * s.velocity("n2")));
}

TEST_CASE("a step through friction follows its curve, and the rest of the work is heat") {
  constexpr double sigma = 193.0, Fc = 2.3, exponent = 1.37, f0 = -1.1;
  for (const double sign : {1.0, -1.0}) {
    SceneBuilder b;
    b.motion("drive", "end", "position", step(sign * dx));
    b.between("f", "sfm", "end", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", exponent}, {"f0", f0}});
    const Started s(b);
    const SolidFriction law(sigma, Fc, exponent);
    CHECK_EQ(s.force("f"), exactly(law.force(f0, sign * dx)));
    double work = 0;
    constexpr int slices = 20000;
    for (int n = 0; n < slices; ++n) work += law.force(f0, sign * dx * (n + 0.5) / slices) * sign * dx / slices;
    const double f = s.force("f");
    CHECK_EQ(s.jump.heat, doctest::Approx(work - (f * f - f0 * f0) / (2 * sigma)).epsilon(1e-5));
    CHECK(s.jump.heat > 0);
  }
}

TEST_CASE("a step that friction shares with a spring: the balance decides") {
  constexpr double sigma = 193.0, Fc = 2.3, exponent = 0.63;
  for (const double sign : {1.0, -1.0}) {
    SceneBuilder b;
    b.motion("drive", "end", "position", step(sign * dx));
    b.between("k", "spring", "end", "mid", {{"stiffness", k}});
    b.between("f", "sfm", "mid", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", exponent}});
    const Started s(b);
    const SolidFriction law(sigma, Fc, exponent);
    const double f = s.force("k");
    CHECK_EQ(s.force("f"), exactly(f));
    CHECK_EQ(s.position("mid"), exactly(sign * dx - f / k));
    CHECK_EQ(law.force(0, sign * dx - f / k), doctest::Approx(f).epsilon(1e-9));
  }
}

TEST_CASE("start values that contradict each other are refused, with both named") {
  const auto refusal = [](const SceneBuilder& b) {
    try {
      const Started s(b);
    } catch (const SimulationError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  SceneBuilder b;
  b.between("k", "spring", "a", "ground", {{"stiffness", k}, {"d0", 0.2}});
  b.at("m", "mass", "a", {{"mass", m}});
  b.start("a", 0.3);
  CHECK(refusal(b).find(
            "element `k` cannot start with the displacement d0 = 0.2 m: nodes `a` and `ground` start 0.3 m apart") == 0);
  b.start("a", 0.2);
  CHECK_EQ(refusal(b), "");

  SceneBuilder moved;
  moved.motion("drive", "a", "velocity", Signal(Signal::Constant{0.7}));
  moved.between("k", "spring", "a", "ground", {{"stiffness", k}});
  moved.start("a", 0, 0.6);
  CHECK(refusal(moved).find("node `a` cannot start with velocity 0.6 m/s: motion `drive` gives it 0.7 m/s") == 0);
  moved.start("a", 0.13, 0.7);
  CHECK_EQ(refusal(moved), "");

  SceneBuilder placed;
  placed.motion("drive", "a", "position", Signal(Signal::Constant{0.7}));
  placed.between("k", "spring", "a", "ground", {{"stiffness", k}});
  placed.start("a", 0.6);
  CHECK(refusal(placed).find("node `a` cannot start at position 0.6 m: motion `drive` puts it at 0.7 m") == 0);
}

TEST_CASE("a given start position of a driven node is where it was before: it does not step from 0") {
  constexpr double x0 = 0.71;
  SceneBuilder b;
  b.motion("drive", "end", "position", Signal(Signal::Sine{x0, 1.3, std::acos(-1.0) / 2, 0, 0}));
  b.between("c", "dashpot", "end", "mass", {{"damping", B}});
  b.between("k", "spring", "end", "mass", {{"stiffness", k}});
  b.at("m", "mass", "mass", {{"mass", m}});
  const Started stepped(b);
  CHECK_EQ(stepped.velocity("mass"), exactly(B * x0 / m));
  CHECK_EQ(stepped.jump.notes.size(), 1);
  // In decimals, as a netlist has it: equal but for rounding.
  for (const double given : {x0, x0 * (1 + 1e-13)}) {
    b.start("end", given);
    b.start("mass", x0);
    const Started s(b);
    CHECK_EQ(s.velocity("mass"), 0);
    CHECK_EQ(s.position("end"), exactly(x0));
    CHECK(std::abs(s.force("k")) < digits * k * x0);
    CHECK(s.jump.notes.empty());
  }
}

TEST_CASE("an initial displacement places a node that nothing else places") {
  SceneBuilder b;
  b.at("m", "mass", "a", {{"mass", m}});
  b.between("c", "dashpot", "a", "b", {{"damping", B}, {"d0", 0.17}});
  b.at("m2", "mass", "b", {{"mass", m}});
  b.between("k", "spring", "ground", "b", {{"stiffness", k}, {"d0", -0.41}, {"rest", 0.05}});
  const Started s(b);
  CHECK_EQ(s.position("b"), exactly(0.41));
  CHECK_EQ(s.position("a"), exactly(0.58));
  CHECK_EQ(s.deflection("k"), exactly(-0.46));
}

TEST_CASE("an initial force goes before the rest length, and the displacement is what the nodes say") {
  SceneBuilder b;
  b.at("m", "mass", "a", {{"mass", m}});
  b.between("k", "spring", "a", "ground", {{"stiffness", k}, {"rest", 0.3}, {"f0", -1.3}});
  b.start("a", 0.19, 0);
  const Started s(b);
  CHECK_EQ(s.force("k"), exactly(-1.3));
  CHECK_EQ(s.position("a"), exactly(0.19));
  CHECK_EQ(s.acceleration("a"), exactly(1.3 / m));
}

}  // namespace rheonet::test::start_test
