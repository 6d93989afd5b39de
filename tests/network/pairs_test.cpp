// Which springs and sliders in series are taken for one element.
#include <doctest/doctest.h>

#include <limits>

#include "core/network/network.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::pairs_test {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A driven mass, a spring and a slider from it to ground; `more` may add or change something.
template <class More>
std::size_t pairs_with(const More& more, double coulomb = 1.3, double breakaway = 1.3) {
  SceneBuilder b;
  b.at("m", "mass", "x", {{"mass", 0.7}});
  b.between("k", "spring", "x", "mid", {{"stiffness", 31.0}});
  b.between("s", "slider", "mid", "ground", {{"coulomb", coulomb}, {"breakaway", breakaway}});
  more(b);
  const Scene scene = b.finish(1, 10, 1e-6);
  return build_network(scene).pairs.size();
}

}  // namespace

TEST_CASE("a spring and a slider through a node that nothing else touches are a pair") {
  CHECK_EQ(pairs_with([](SceneBuilder&) {}), 1);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.start("mid", 0.1); }), 1);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.between("k2", "spring", "x", "ground", {{"stiffness", 3.0}}); }), 1);
}

TEST_CASE("what is more than a pair is left alone") {
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.at("m2", "mass", "mid", {{"mass", 0.1}}); }), 0);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.force("f", "mid", Signal(Signal::Constant{0.1})); }), 0);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.motion("d", "mid", "velocity", Signal(Signal::Constant{0.1})); }), 0);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.between("c", "dashpot", "mid", "ground", {{"damping", 0.1}}); }), 0);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.between("k2", "spring", "mid", "x", {{"stiffness", 0.1}}); }), 0);
  // An element without a force still has a displacement and a velocity there.
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.between("k2", "spring", "mid", "x", {{"stiffness", 0}}); }), 0);
  CHECK_EQ(pairs_with([](SceneBuilder& b) { b.start("mid", not_given, 0); }), 0);
  CHECK_EQ(pairs_with([](SceneBuilder&) {}, 1.3, 1.4), 0);
  CHECK_EQ(pairs_with([](SceneBuilder&) {}, infinite, infinite), 0);
  CHECK_EQ(pairs_with([](SceneBuilder&) {}, 0, 0), 0);
  // A pair from a node to itself.
  SceneBuilder b;
  b.at("m", "mass", "x", {{"mass", 0.7}});
  b.between("k", "spring", "x", "mid", {{"stiffness", 31.0}});
  b.between("s", "slider", "mid", "x", {{"coulomb", 1.3}, {"breakaway", 1.3}});
  const Scene loop = b.finish(1, 10, 1e-6);
  CHECK(build_network(loop).pairs.empty());
}

TEST_CASE("limits of other laws make pairs too: what counts is the law, not its name") {
  SceneBuilder b;
  b.at("m", "mass", "x", {{"mass", 0.7}});
  b.between("k", "cfm", "x", "mid", {{"stiffness", 31.0}, {"coulomb", infinite}, {"damping", infinite}});
  b.between("s", "sfm", "mid", "ground", {{"stiffness", infinite}, {"coulomb", 1.3}});
  const Scene scene = b.finish(1, 10, 1e-6);
  const Network network = build_network(scene);
  REQUIRE_EQ(network.pairs.size(), 1);
  CHECK_EQ(network.pairs[0].law.stiffness, 31);
  CHECK_EQ(network.pairs[0].coulomb, 1.3);
}

TEST_CASE("pairs between the same nodes are one branch, whichever way they are written") {
  SceneBuilder b;
  b.at("m", "mass", "x", {{"mass", 0.7}});
  b.between("k0", "spring", "x", "n0", {{"stiffness", 31.0}});
  b.between("s0", "slider", "n0", "ground", {{"coulomb", 1.3}, {"breakaway", 1.3}});
  b.between("k1", "spring", "ground", "n1", {{"stiffness", 41.0}});
  b.between("s1", "slider", "x", "n1", {{"coulomb", 1.7}, {"breakaway", 1.7}});
  b.at("m2", "mass", "y", {{"mass", 0.7}});
  b.between("s2", "slider", "n2", "y", {{"coulomb", 1.9}, {"breakaway", 1.9}});
  b.between("k2", "spring", "n2", "x", {{"stiffness", 41.0}});
  const Scene scene = b.finish(1, 10, 1e-6);
  const Network network = build_network(scene);
  CHECK_EQ(network.nodes(), 3);
  REQUIRE_EQ(network.deflections.size(), 2);
  REQUIRE_EQ(network.bundles->size(), 2);
  CHECK_EQ((*network.bundles)[0].size(), 2);
  CHECK_EQ((*network.bundles)[1].size(), 1);
  CHECK_EQ(network.node_name(network.deflections[0].a), "x");
  CHECK_EQ(network.name_of(network.deflections[0]), "s0");
  CHECK_EQ(network.pairs[0].sign, 1);
  CHECK_EQ(network.pairs[1].sign, -1);
  CHECK(network.sliders.empty());
}

TEST_CASE("a chain of springs and sliders makes as many pairs as fit") {
  SceneBuilder b;
  b.motion("d", "x", "velocity", Signal(Signal::Constant{0.1}));
  b.between("k0", "spring", "x", "n0", {{"stiffness", 31.0}});
  b.between("s0", "slider", "n0", "n1", {{"coulomb", 1.3}, {"breakaway", 1.3}});
  b.between("k1", "spring", "n1", "n2", {{"stiffness", 41.0}});
  b.between("s1", "slider", "n2", "ground", {{"coulomb", 1.7}, {"breakaway", 1.7}});
  const Scene scene = b.finish(1, 10, 1e-6);
  const Network network = build_network(scene);
  CHECK_EQ(network.pairs.size(), 2);
  CHECK_EQ(network.nodes(), 3);
}

}  // namespace rheonet::test::pairs_test
