// Steps of positions through dashpots with a power law, f = B |w|^n: the limit of ever faster ramps.

#include "core/dae/dashpot_steps.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "core/network/error.hpp"
#include "tests/support/probe.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::dashpot_steps_test {

namespace {

constexpr double dx = 0.0193, B = 2.71, B2 = 0.83, m = 0.47;

/// Where a scene's step of a position at the start takes its nodes.
class Stepped {
 public:
  explicit Stepped(const SceneBuilder& builder) : scene_(builder.finish(1, 10, 1e-6)) {
    const Network network = build_network(scene_);
    const Structure structure = classify(network);
    dx_.assign(scene_.nodes.size(), 0);
    for (const Network::Motion& motion : network.motions) {
      dx_[static_cast<std::size_t>(motion.node)] = motion.signal.value(0) - motion.signal.before(0);
    }
    REQUIRE(go_with_dashpots(network, structure, dx_));
  }

  double operator[](const std::string& node) const {
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      if (scene_.nodes[n].name == node) return dx_[n];
    }
    FAIL("no node " << node);
    return 0;
  }

 private:
  Scene scene_;
  std::vector<double> dx_;
};

SceneBuilder stepping(double height = dx) {
  SceneBuilder b;
  b.motion("drive", "end", "position", Signal(Signal::Step{height, 0, 0}));
  return b;
}

doctest::Approx nearly(double value) { return doctest::Approx(value).epsilon(1e-10); }

}  // namespace

TEST_CASE("dashpots of one exponent share a step so that their forces are equal") {
  for (const double n : {0.05, 0.3, 0.7, 1.0, 1.4, 2.0, 7.0}) {
    CAPTURE(n);
    for (const double height : {dx, -dx, 1e-7 * dx}) {
      SceneBuilder b = stepping(height);
      b.between("c", "dashpot", "mid", "end", {{"damping", B}, {"flow_index", n}});
      b.between("c2", "dashpot", "mid", "ground", {{"damping", B2}, {"flow_index", n}});
      const double x = Stepped(b)["mid"];
      // B |dx - x|^n = B2 |x|^n
      CHECK_EQ(x, nearly(height / (1 + std::pow(B2 / B, 1 / n))));
    }
  }
}

TEST_CASE("of dashpots in series the one of the smallest exponent gives way, whatever the coefficients") {
  for (const bool swapped : {false, true}) {
    SceneBuilder b = stepping();
    b.between("c", "dashpot", "end", "n1", {{"damping", swapped ? B : 1e-3 * B}, {"flow_index", swapped ? 1.0 : 0.4}});
    b.between("c2", "dashpot", "n1", "n2", {{"damping", 1e3 * B}, {"flow_index", swapped ? 0.4 : 1.0}});
    b.between("c3", "dashpot", "n2", "ground", {{"damping", B}, {"flow_index", 1.9}});
    const Stepped steps(b);
    CHECK_LE(std::abs(steps["n1"] - (swapped ? dx : 0)), 1e-9 * dx);
    CHECK_LE(std::abs(steps["n2"]), 1e-12 * dx);
  }
}

TEST_CASE("nodes that stiffer dashpots join go as one, and share the step with what is softer") {
  SceneBuilder b = stepping();
  b.between("c", "dashpot", "end", "n1", {{"damping", B}, {"flow_index", 0.6}});
  b.between("c2", "dashpot", "n1", "n2", {{"damping", B2}, {"flow_index", 1.3}});
  b.between("c3", "dashpot", "n2", "n3", {{"damping", B2}});
  b.between("c4", "dashpot", "ground", "n3", {{"damping", B2}, {"flow_index", 0.6}});
  b.between("c5", "dashpot", "n2", "ground", {{"damping", B}, {"flow_index", 0.2}});
  const Stepped steps(b);
  const double x = dx / (1 + std::pow(B2 / B, 1 / 0.6));
  for (const char* node : {"n1", "n2", "n3"}) CHECK_EQ(steps[node], nearly(x));
}

TEST_CASE("a shear-thinning dashpot takes no impulse, and there is nothing to say of it") {
  for (const double n : {0.05, 0.37, 0.9}) {
    SceneBuilder b = stepping();
    b.between("thin", "dashpot", "end", "mass", {{"damping", B}, {"flow_index", n}});
    b.at("m", "mass", "mass", {{"mass", m}});
    b.start("mass", 0, 0.29);
    CHECK(Probe(b.finish(1, 10, 1e-6)).change().notes.empty());
    SceneBuilder both = b;
    both.between("c2", "dashpot", "end", "mass", {{"damping", B2}});
    Probe probe(both.finish(1, 10, 1e-6));
    CHECK_EQ(probe.change().notes.size(), 1);
    const auto mass = static_cast<std::size_t>(probe.dae().indices().velocity[at(b.node("mass"))]);
    CHECK_EQ(probe.y()[mass], doctest::Approx(0.29 + B2 * dx / m).epsilon(1e-14));
  }
}

TEST_CASE("a shear-thickening dashpot between a step and a mass is refused; beside what gives way it is rigid") {
  const auto refused = [](SceneBuilder scene, const std::string& dashpot) {
    const std::string reason = "at t = 0 s a step in position reaches the mass at node `mass` through dashpot `" + dashpot + "`";
    CHECK_THROWS_WITH_AS(Probe(scene.finish(1, 10, 1e-6)), doctest::Contains(reason.c_str()), SimulationError);
  };
  SceneBuilder b = stepping();
  b.between("thick", "dashpot", "mid", "end", {{"damping", B}, {"flow_index", 1.5}});
  b.between("c", "dashpot", "mid", "mass", {{"damping", B2}});
  b.at("m", "mass", "mass", {{"mass", m}});
  Probe probe(b.finish(1, 10, 1e-6));
  const auto mass = static_cast<std::size_t>(probe.dae().indices().velocity[at(b.node("mass"))]);
  CHECK_EQ(probe.y()[mass], doctest::Approx(B2 * dx / m).epsilon(1e-14));
  REQUIRE_EQ(probe.change().notes.size(), 1);
  CHECK(probe.change().notes[0].find("moves dashpot `c` by 0.0193 m in no time") != std::string::npos);

  // A stiffer one holds `mid` to the mass: now the infinite impulse comes there.
  SceneBuilder held = b;
  held.between("thick2", "dashpot", "mid", "mass", {{"damping", B}, {"flow_index", 2}});
  refused(held, "thick");
  b.between("thick2", "dashpot", "end", "mass", {{"damping", B}, {"flow_index", 2}});
  refused(b, "thick2");
}

TEST_CASE("a rigid dashpot passes an impulse on to the mass behind it") {
  SceneBuilder b = stepping(-dx);
  b.between("c", "dashpot", "end", "mid", {{"damping", B}});
  b.between("thick", "dashpot", "mass", "mid", {{"damping", B2}, {"flow_index", 2}});
  b.between("thin", "dashpot", "mid", "ground", {{"damping", B2}, {"flow_index", 0.5}});
  b.at("m", "mass", "mass", {{"mass", m}});
  Probe probe(b.finish(1, 10, 1e-6));
  const auto mass = static_cast<std::size_t>(probe.dae().indices().velocity[at(b.node("mass"))]);
  CHECK_EQ(probe.y()[mass], doctest::Approx(-B * dx / m).epsilon(1e-14));

  b.between("thick2", "dashpot", "mid", "ground", {{"damping", B2}, {"flow_index", 1.5}});
  CHECK_THROWS_WITH_AS(Probe(b.finish(1, 10, 1e-6)), doctest::Contains("which share of its impulse"), SimulationError);
}

}  // namespace rheonet::test::dashpot_steps_test
