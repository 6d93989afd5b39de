#include "core/network/free_ends.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/network/network.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::free_ends_test {

namespace {

constexpr double k = 137.3, B = 2.71, Fc = 0.83;

/// A mass on a spring that is pushed, from which a chain with a mesh at its end hangs: m - x - (y, z).
SceneBuilder hanging(const std::string& hangs_on = "m") {
  SceneBuilder b;
  b.at("heavy", "mass", "m", {{"mass", 0.31}});
  b.between("held", "spring", "m", "ground", {{"stiffness", k}});
  b.force("push", "m", Signal(Signal::Constant{1.7}));
  b.between("h1", "dashpot", hangs_on, "x", {{"damping", B}});
  b.between("h2", "slider", "x", "y", {{"coulomb", Fc}});
  b.between("h3", "spring", "y", "z", {{"stiffness", 0.7 * k}});
  b.between("h4", "sfm", "z", "x", {{"stiffness", k}, {"coulomb", Fc}, {"exponent", 1}});
  return b;
}

/// The name of the node that a node hangs on; its own where it does not.
std::string on(const Scene& scene, const std::string& name) {
  const Network network = build_network(scene);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].name == name) return scene.nodes[static_cast<std::size_t>(network.free_ends.on[n])].name;
  }
  FAIL("no node " << name);
  return "";
}

Scene finished(const SceneBuilder& b) { return b.finish(1.37, 137, 1e-9); }

}  // namespace

TEST_CASE("what hangs on one node alone moves with it, and carries no force") {
  for (const std::string anchor : {"m", "ground"}) {
    const Scene scene = finished(hanging(anchor));
    for (const char* node : {"x", "y", "z"}) CHECK_EQ(on(scene, node), anchor);
    CHECK_EQ(on(scene, "m"), "m");
    const Network network = build_network(scene);
    CHECK_EQ(network.deflections.size(), 1);
    CHECK(network.rates.empty());
    CHECK(network.sliders.empty());
    REQUIRE_EQ(network.notes.size(), 1);
    CHECK_EQ(network.notes[0], "nodes `x`, `y`, `z` hang on `" + anchor + "` alone and " + (anchor == "m" ? "move with it" : "rest") +
                                    ": `h1`, `h2`, `h3`, `h4` carry no force");
    const RunTable run = simulate(scene);
    for (const char* element : {"h1", "h2", "h3", "h4"}) {
      CHECK_EQ(run.scale(std::string(element) + ".force"), 0);
      CHECK_EQ(run.scale(std::string(element) + ".displacement"), 0);
    }
    const double w = std::sqrt(k / 0.31), moves = anchor == "m" ? 1 : 0;
    for (std::size_t i = 0; i < run.time().size(); ++i) {
      CHECK_EQ(run["z.position"][i], doctest::Approx(moves * 1.7 / k * (1 - std::cos(w * run.time()[i]))).epsilon(1e-7));
      CHECK_EQ(run["z.velocity"][i], moves * run["m.velocity"][i]);
    }
  }
}

TEST_CASE("a node that hangs has the name of a mass, mistyped: the note says which") {
  for (const char* node : {"loda", "rope"}) {
    SceneBuilder b;
    b.at("heavy", "mass", "trolley", {{"mass", 0.31}});
    b.at("cargo", "mass", "load", {{"mass", 0.31}});
    b.between("h1", "spring", node, "trolley", {{"stiffness", k}});
    b.between("h2", "dashpot", node, "trolley", {{"damping", B}});
    const Network network = build_network(finished(b));
    REQUIRE_EQ(network.notes.size(), 1);
    CHECK_EQ(network.notes[0], fmt::format("node `{}` hangs on `trolley` alone and moves with it: `h1`, `h2` carry no force{}", node, std::string(node) == "loda" ? "; did you mean `load`?" : ""));
  }
}

TEST_CASE("elements side by side hang as one does, whatever is written first") {
  for (const bool mass_first : {true, false}) {
    SceneBuilder b;
    if (mass_first) b.at("heavy", "mass", "m", {{"mass", 0.31}});
    b.between("h1", "vfm", "m", "x", {{"stiffness", k}, {"damping", B}, {"delay", 0.1}});
    b.between("h2", "vfm", "x", "m", {{"stiffness", 0.3 * k}, {"damping", B}, {"delay", 0.2}});
    b.between("held", "spring", "m", "ground", {{"stiffness", k}});
    if (!mass_first) b.at("heavy", "mass", "m", {{"mass", 0.31}});
    b.force("push", "m", Signal(Signal::Constant{1.7}));
    CHECK_EQ(on(finished(b), "x"), "m");
  }
}

TEST_CASE("what else holds a node keeps it, and all on the way to it, from hanging free") {
  const auto hangs = [](const SceneBuilder& b, const char* node) { return on(finished(b), node) != node; };
  SUBCASE("a mass") {
    SceneBuilder b = hanging();
    b.at("light", "mass", "x", {{"mass", 1e-12}});
    CHECK_FALSE(hangs(b, "x"));
    CHECK_EQ(on(finished(b), "y"), "x");
    CHECK_EQ(on(finished(b), "z"), "x");
  }
  SUBCASE("a force") {
    SceneBuilder b = hanging();
    b.force("pull", "z", Signal(Signal::Constant{0}));
    for (const char* node : {"x", "y", "z"}) CHECK_FALSE(hangs(b, node));
  }
  SUBCASE("another way to what is held") {
    SceneBuilder b = hanging();
    b.between("way", "dashpot", "y", "ground", {{"damping", B}});
    for (const char* node : {"x", "y", "z"}) CHECK_FALSE(hangs(b, node));
  }
  SUBCASE("a motion, on which the others hang") {
    SceneBuilder b = hanging();
    b.motion("drive", "y", "velocity", Signal(Signal::Constant{0.3}));
    CHECK_FALSE(hangs(b, "x"));
    CHECK_FALSE(hangs(b, "z"));  // it lies between x and y
    b.between("end", "spring", "y", "w", {{"stiffness", k}});
    CHECK_EQ(on(finished(b), "w"), "y");
  }
  SUBCASE("a start value, wherever it is in the same part") {
    for (const char* node : {"m", "x", "z"}) {
      SceneBuilder b = hanging();
      b.start(node, 0.013);
      CHECK_FALSE(hangs(b, "x"));
      CHECK_FALSE(hangs(b, "z"));
    }
    SceneBuilder elsewhere = hanging();
    elsewhere.at("other", "mass", "o", {{"mass", 1.1}});
    elsewhere.between("k1", "spring", "o", "ground", {{"stiffness", k}});
    elsewhere.start("o", 0.013);
    CHECK(hangs(elsewhere, "x"));
  }
  SUBCASE("a force from the start") {
    for (const double f0 : {0.0, 0.31}) {
      SceneBuilder b = hanging();
      b.between("begins", "sfm", "z", "x", {{"stiffness", k}, {"coulomb", Fc}, {"exponent", 1}, {"f0", f0}});
      CHECK_EQ(hangs(b, "y"), f0 == 0);
    }
    for (const double rest : {0.0, 0.0031}) {
      SceneBuilder b = hanging();
      b.between("longer", "spring", "z", "x", {{"stiffness", k}, {"rest", rest}});
      CHECK_EQ(hangs(b, "y"), rest == 0);
    }
  }
}

}  // namespace rheonet::test::free_ends_test
