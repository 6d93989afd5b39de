// What happens within one instant: consistent starts, and steps that go through a network.

#include <doctest/doctest.h>

#include <cmath>

#include "core/network/index.hpp"
#include "tests/support/probe.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/solid_friction.hpp"

namespace rheonet::test {

namespace {

constexpr double k = 137.3, k2 = 71.9, B = 2.71, B2 = 0.83, m = 0.47, dx = 0.0193, F = 3.7;
constexpr double digits = 1e-12;

Signal step(double height) { return Signal(Signal::Step{height, 0, 0}); }

/// A scene just after its first instant.
class Started {
 public:
  explicit Started(const SceneBuilder& builder)
      : scene_(builder.finish(1, 10, 1e-6)), probe_(scene_), jump(probe_.change()) {
    view_ = probe_.dae().view(0, probe_.y().data(), probe_.yp().data());
  }

  double velocity(const std::string& node) const { return view_.velocity[at(id(node))]; }
  double position(const std::string& node) const { return view_.position[at(id(node))]; }
  double reaction(const std::string& node) const { return probe_.dae().reaction(id(node)); }
  double force(const std::string& element) const {
    const Network::Place place = place_of(element);
    return place.role == Role::rate ? view_.rate_force[at(place.index)] : view_.f[at(place.index)];
  }
  double deflection(const std::string& element) const { return view_.p[at(place_of(element).index)]; }
  double deflection_rate(const std::string& element) const { return view_.dp[at(place_of(element).index)]; }
  double acceleration(const std::string& node) const { return probe_.yp()[at(probe_.dae().velocity_unknown(id(node)))]; }
  const Dae::View& view() const { return view_; }

 private:
  NodeId id(const std::string& node) const {
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      if (scene_.nodes[n].name == node) return static_cast<NodeId>(n);
    }
    FAIL("no node " << node);
    return -1;
  }
  Network::Place place_of(const std::string& element) const {
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (scene_.elements[e].name == element) return probe_.network().places[e];
    }
    FAIL("no element " << element);
    return {};
  }

  Scene scene_;
  mutable Probe probe_;
  Dae::View view_;

 public:
  const Instant::Change& jump;
};

doctest::Approx exactly(double value) { return doctest::Approx(value).epsilon(digits); }

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

TEST_CASE("an initial force goes on through what stands in series with it") {
  constexpr double f0 = 1.7, sigma = 193.0;
  SceneBuilder b;
  b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
  b.start("end", 0.23);
  b.between("v", "vfm", "end", "n1", {{"damping", B}, {"stiffness", sigma}, {"f0", f0}});
  b.between("f", "sfm", "n2", "n1", {{"stiffness", sigma}, {"coulomb", 2.3}, {"exponent", 0.6}});
  b.between("c", "cfm", "n2", "n3", {{"damping", B2}, {"stiffness", k2}, {"coulomb", 2.9}, {"exponent", 1.2}});
  b.between("k", "spring", "n3", "ground", {{"stiffness", k}, {"rest", 0.05}});
  const Started s(b);
  CHECK_EQ(s.force("v"), exactly(f0));
  CHECK_EQ(s.force("f"), exactly(-f0));
  CHECK_EQ(s.force("c"), exactly(f0));
  CHECK_EQ(s.force("k"), exactly(f0));
  // Only the spring's force says where a node is.
  CHECK_EQ(s.position("n3"), exactly(0.05 + f0 / k));
}

TEST_CASE("an initial force and a load at a massless node: springs there make up for both") {
  constexpr double f0 = -0.9, load = 3.1;
  SceneBuilder b;
  b.between("v", "vfm", "n", "ground", {{"damping", B}, {"stiffness", k2}, {"f0", f0}});
  b.between("k", "spring", "n", "ground", {{"stiffness", k}});
  b.between("k2", "spring", "ground", "n", {{"stiffness", k2}, {"rest", 0.01}});
  b.force("push", "n", Signal(Signal::Constant{load}));
  const Started s(b);
  CHECK_EQ(s.force("v"), exactly(f0));
  CHECK_EQ(s.force("k") - s.force("k2"), exactly(load - f0));
  CHECK_EQ(s.position("n"), exactly((load - f0 - k2 * 0.01) / (k + k2)));
}

TEST_CASE("initial forces that do not balance at a massless node are refused, with all of them named") {
  const auto refusal = [](double f1, double f2, double load, double before) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
    b.between("one", "vfm", "end", "n", {{"damping", B}, {"stiffness", k}, {"f0", f1}});
    b.between("two", "sfm", "n", "ground", {{"stiffness", k2}, {"coulomb", 5.1}, {"f0", f2}});
    b.force("push", "n", Signal(Signal::Step{load - before, 0, before}));
    try {
      const Started s(b);
    } catch (const SimulationError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  // f2 - f1 = load, just before the start or just after.
  CHECK_EQ(refusal(1.3, 3.8, 2.5, 2.5), "");
  CHECK_EQ(refusal(1.3, 3.8, 2.5, 0.4), "");
  CHECK_EQ(refusal(1.3, 3.8, 0.4, 2.5), "");
  CHECK_EQ(refusal(1.3, 3.8 * (1 + 1e-8), 2.5, 2.5), "");  // less than the accuracy asked for
  const std::string text = refusal(1.3, 3.8001, 2.5, 2.5);
  CHECK(text.find("the initial forces at node `n` do not balance, and it has no mass: ") == 0);
  CHECK(text.find("`one` ") != std::string::npos);
  CHECK(text.find("with 1.3 N") != std::string::npos);
  CHECK(text.find("`two` ") != std::string::npos);
  CHECK(text.find("with 3.8001 N") != std::string::npos);
  CHECK(refusal(1.3, -3.8, 2.5, 2.5) != "");
}

TEST_CASE("a place of a massless node between springs at which their forces do not balance is refused") {
  const auto refused = [](double x) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal());
    b.start("end", 0.23);
    b.between("k", "spring", "end", "n", {{"stiffness", k}});
    b.between("k2", "spring", "n", "ground", {{"stiffness", k2}});
    b.start("n", x);
    try {
      const Started s(b);
    } catch (const SimulationError&) {
      return true;
    }
    return false;
  };
  constexpr double balanced = 0.23 * k / (k + k2);
  CHECK_FALSE(refused(balanced));
  CHECK(refused(balanced * 1.001));
  CHECK(refused(-balanced));
  CHECK_FALSE(refused(not_given));
}

TEST_CASE("an initial force goes on through springs in a row, and beside one another") {
  constexpr double f0 = 0.47;
  for (const bool beside : {false, true}) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
    b.between("v", "vfm", "end", "p", {{"damping", B}, {"stiffness", 31.0}, {"f0", f0}});
    b.between("k1", "spring", "p", "q", {{"stiffness", k}, {"rest", 0.02}});
    b.between("k2", "spring", "r", "q", {{"stiffness", k2}});
    b.between("k3", "spring", "r", "ground", {{"stiffness", 23.0}});
    if (beside) b.between("k4", "spring", "p", "r", {{"stiffness", 17.0}});
    const Started s(b);
    CHECK_EQ(s.force("v"), exactly(f0));
    CHECK_EQ(s.force("k1") + (beside ? s.force("k4") : 0), exactly(f0));
    CHECK_EQ(s.force("k1"), exactly(-s.force("k2")));
    CHECK_EQ(s.force("k3"), exactly(f0));
    CHECK_EQ(s.position("r"), exactly(f0 / 23));
    CHECK_EQ(s.force("k1"), exactly(k * (s.position("p") - s.position("q") - 0.02)));
  }
}

TEST_CASE("nodes between springs that nothing else holds start where the initial forces on both sides leave them") {
  const auto started = [](double other) {
    SceneBuilder b;
    b.motion("drive", "end", "velocity", Signal(Signal::Constant{0.31}));
    b.between("v", "vfm", "end", "p", {{"damping", B}, {"stiffness", 31.0}, {"f0", 0.47}});
    b.between("k1", "spring", "p", "q", {{"stiffness", k}});
    b.between("w", "vfm", "q", "ground", {{"damping", B2}, {"stiffness", 29.0}, {"f0", other}});
    return Started(b);
  };
  for (const double other : {not_given, 0.47}) {
    const Started s = started(other);
    CHECK_EQ(s.force("v"), exactly(0.47));
    CHECK_EQ(s.force("w"), exactly(0.47));
    CHECK_EQ(s.position("p") - s.position("q"), exactly(0.47 / k));
  }
  CHECK_THROWS_AS(started(0.48), SimulationError);
}

TEST_CASE("the place of a massless node in a row of springs at which their forces do not balance is refused") {
  const auto refused = [](double x) {
    SceneBuilder c;
    c.at("m", "mass", "x", {{"mass", m}});
    c.start("x", 0.01);
    c.between("k0", "spring", "x", "p", {{"stiffness", 30.0}});
    c.between("k1", "spring", "p", "q", {{"stiffness", 20.0}});
    c.between("k2", "spring", "q", "ground", {{"stiffness", 40.0}});
    c.start("p", x);
    try {
      const Started started(c);
    } catch (const SimulationError&) {
      return true;
    }
    return false;
  };
  const double balanced = 0.01 * 30 / (30 + 40.0 / 3);
  CHECK_FALSE(refused(balanced));
  CHECK(refused(1.001 * balanced));
}

}  // namespace rheonet::test
