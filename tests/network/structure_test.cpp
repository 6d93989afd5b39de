#include "core/base/index.hpp"
#include "core/network/structure.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "core/network/error.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::structure_test {

namespace {

Modes all_slip(const Network& network) {
  return {std::vector<signed char>(network.sliders.size(), Modes::forward), {}};
}

/// A scene, its network and its structure, and how to ask for parts of them by name.
struct Analysed {
  Scene scene;
  Network network;
  Structure structure;

  explicit Analysed(const SceneBuilder& builder)
      : scene(builder.finish(1, 10, 1e-6)), network(build_network(scene)), structure(analyse(network, all_slip(network))) {}
  Analysed(const Analysed&) = delete;  // the network points to the scene

  NodeId node(const std::string& name) const {
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
      if (scene.nodes[n].name == name) return static_cast<NodeId>(n);
    }
    FAIL("no node " << name);
    return -1;
  }
  int branch(const std::string& name) const {
    for (std::size_t j = 0; j < network.deflections.size(); ++j) {
      if (network.name_of(network.deflections[j]) == name) return static_cast<int>(j);
    }
    FAIL("no deflection branch " << name);
    return -1;
  }
  Kind kind(const std::string& name) const { return structure.kind[at(node(name))]; }
  int group(const std::string& name) const { return structure.group[at(node(name))]; }
  const Structure::Group& group_of(const std::string& name) const { return structure.groups.at(at(group(name))); }
  std::vector<Structure::Loop> loops() const {
    std::vector<Structure::Loop> all;
    for (const int b : structure.closing) all.push_back(closed_loop(network, structure, b));
    return all;
  }
  std::optional<Structure::Loop> loop(const std::string& closed_by) const {
    const int b = branch(closed_by);
    if (std::find(structure.closing.begin(), structure.closing.end(), b) == structure.closing.end()) return std::nullopt;
    return closed_loop(network, structure, b);
  }
};

/// The error for a refused scene.
std::string refusal(const SceneBuilder& builder) {
  try {
    const Analysed analysed(builder);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

constexpr double k = 137.3, B = 2.71, m = 0.83, v = 0.47;

void spring(SceneBuilder& b, const std::string& name, const std::string& a, const std::string& c) {
  b.between(name, "spring", a, c, {{"stiffness", k}});
}
void dashpot(SceneBuilder& b, const std::string& name, const std::string& a, const std::string& c) {
  b.between(name, "dashpot", a, c, {{"damping", B}});
}
void mass(SceneBuilder& b, const std::string& node) { b.at("mass of " + node, "mass", node, {{"mass", m}}); }
void drive(SceneBuilder& b, const std::string& node) {
  b.motion("motion of " + node, node, "velocity", Signal(Signal::Constant{v}));
}

double sum_over(const Structure::Loop& loop, const std::vector<double>& flow, const std::vector<double>& velocity) {
  double sum = 0;
  for (const Structure::Term& term : loop.flows) sum += term.sign * flow[at(term.index)];
  for (const Structure::Term& term : loop.velocities) sum += term.sign * velocity[at(term.index)];
  return sum;
}

/// The identities that a structure promises, whatever the network: for any velocities of the nodes, each loop sums to
/// 0, and `minus_velocity` gives each velocity back.
void check_identities(const Analysed& net, Random& random) {
  const Structure& s = net.structure;
  const std::size_t nodes = net.scene.nodes.size();
  std::vector<double> velocity(nodes, 0);
  for (std::size_t n = 1; n < nodes; ++n) velocity[n] = random.uniform(-3, 3);
  std::vector<double> flow;
  for (const Branch& b : net.network.deflections) flow.push_back(velocity[at(b.a)] - velocity[at(b.b)]);
  // Velocities of floating nodes count relative to the first node of their group.
  std::vector<double> relative = velocity;
  for (const Structure::Group& g : s.groups) {
    for (const NodeId n : g.nodes) relative[at(n)] -= velocity[at(g.nodes.front())];
  }
  for (const Structure::Loop& l : net.loops()) {
    CHECK(std::abs(sum_over(l, flow, relative)) < 1e-13);
    const auto own = std::find_if(l.flows.begin(), l.flows.end(), [&](auto& term) { return term.index == l.branch; });
    REQUIRE(own != l.flows.end());
    CHECK_EQ(own->sign, 1);
  }
  for (std::size_t n = 1; n < nodes; ++n) {
    const Structure::Loop l = minus_velocity(s, static_cast<NodeId>(n), ground);
    CHECK_EQ(l.branch, -1);
    CHECK(std::abs(sum_over(l, flow, relative) + velocity[n]) < 1e-13);
    const Structure::Loop to_last = minus_velocity(s, static_cast<NodeId>(n), static_cast<NodeId>(nodes - 1));
    CHECK(std::abs(sum_over(to_last, flow, relative) + velocity[n] - velocity[nodes - 1]) < 1e-13);
    if (s.kind[n] == Kind::floating) continue;
    REQUIRE_EQ(l.velocities.size(), 1);
    CHECK_EQ(l.velocities[0].index, static_cast<int>(n));
    CHECK_EQ(l.velocities[0].sign, -1);
    CHECK(l.flows.empty());
  }
  // A tree branch leads out of its group, towards the root, and no other group uses it.
  std::set<int> tree;
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    const Structure::Group& group = s.groups[g];
    CHECK(tree.insert(group.tree_branch).second);
    const Branch& b = net.network.deflections[at(group.tree_branch)];
    CHECK_EQ(group.node, group.sign > 0 ? b.a : b.b);
    CHECK_EQ(group.parent, group.sign > 0 ? b.b : b.a);
    CHECK_EQ(s.group[at(group.node)], static_cast<int>(g));
    const int parent = s.group[at(group.parent)];
    CHECK(parent < static_cast<int>(g));
    CHECK_EQ(group.depth, parent < 0 ? 1 : s.groups[at(parent)].depth + 1);
  }
  for (const int branch : s.closing) CHECK(!tree.contains(branch));
  std::size_t driven = 0;
  for (const char d : s.driven) driven += d != 0;
  CHECK_EQ(s.groups.size() + s.closing.size() + driven, net.network.deflections.size());
}

}  // namespace

TEST_CASE("structure of Maxwell's element, either way round") {
  for (const bool spring_first : {true, false}) {
    SceneBuilder b;
    drive(b, "end");
    (spring_first ? spring : dashpot)(b, "one", "end", "mid");
    (spring_first ? dashpot : spring)(b, "two", "mid", "ground");
    const Analysed net(b);
    CHECK(net.kind("ground") == Kind::known);
    CHECK(net.kind("end") == Kind::known);
    CHECK(net.kind("mid") == Kind::viscous);
    CHECK(net.structure.groups.empty());
    CHECK_EQ(net.group("mid"), -1);
    const char* const name = spring_first ? "one" : "two";
    CHECK_FALSE(net.structure.driven[at(net.branch(name))]);
    const std::optional<Structure::Loop> loop = net.loop(name);
    REQUIRE(loop);
    CHECK_EQ(loop->flows.size(), 1);
    // p' - (v_a - v_b) = 0; ground has no term.
    CHECK_EQ(loop->velocities.size(), spring_first ? 2 : 1);
    for (const Structure::Term& t : loop->velocities)
      CHECK_EQ(t.sign, t.index == net.node("mid") && spring_first ? 1 : -1);
    Random random(1);
    check_identities(net, random);
  }
}

TEST_CASE("structure of springs in series") {
  SceneBuilder b;
  drive(b, "end");
  spring(b, "k1", "end", "n1");
  spring(b, "k2", "n2", "n1");  // the other way round
  spring(b, "k3", "n2", "n3");
  spring(b, "k4", "n3", "ground");
  const Analysed net(b);
  for (const char* name : {"n1", "n2", "n3"}) CHECK(net.kind(name) == Kind::floating);
  REQUIRE_EQ(net.structure.groups.size(), 3);
  // The tree grows from both ends and meets in the middle: one of four branches closes a loop.
  CHECK_EQ(net.group_of("n1").tree_branch, net.branch("k1"));
  CHECK_EQ(net.group_of("n1").sign, -1);
  CHECK_EQ(net.group_of("n3").tree_branch, net.branch("k4"));
  CHECK_EQ(net.group_of("n3").sign, 1);
  CHECK_EQ(net.group_of("n1").depth, 1);
  CHECK_EQ(net.group_of("n2").depth, 2);
  REQUIRE_EQ(net.structure.closing.size(), 1);
  const Structure::Loop loop = net.loops()[0];
  REQUIRE_EQ(loop.flows.size(), 4);
  // v_end = (p1' - p2' + p3' + p4') with k2 reversed; relative to the branch that closes the loop.
  const auto sign = [&](const char* name) {
    for (const Structure::Term& t : loop.flows) {
      if (t.index == net.branch(name)) return t.sign;
    }
    return 0.0;
  };
  CHECK_EQ(sign("k1"), sign("k3"));
  CHECK_EQ(sign("k1"), sign("k4"));
  CHECK_EQ(sign("k1"), -sign("k2"));
  REQUIRE_EQ(loop.velocities.size(), 1);
  CHECK_EQ(loop.velocities[0].index, net.node("end"));
  CHECK_EQ(loop.velocities[0].sign, -sign("k1"));
  Random random(2);
  check_identities(net, random);
}

TEST_CASE("structure of floating nodes joined by dashpots: one group, whose balance counts as a whole") {
  SceneBuilder b;
  drive(b, "end");
  spring(b, "k1", "end", "n1");
  dashpot(b, "c1", "n1", "n2");
  dashpot(b, "c2", "n3", "n2");
  spring(b, "k2", "n3", "ground");
  spring(b, "k3", "n1", "n3");  // within the group
  const Analysed net(b);
  REQUIRE_EQ(net.structure.groups.size(), 1);
  for (const char* name : {"n1", "n2", "n3"}) {
    CHECK(net.kind(name) == Kind::floating);
    CHECK_EQ(net.group(name), 0);
  }
  CHECK_EQ(net.structure.groups[0].nodes.size(), 3);
  CHECK_EQ(net.structure.closing.size(), 2);
  // A spring between two nodes of one group sees their relative velocities alone.
  const std::optional<Structure::Loop> inner = net.loop("k3");
  REQUIRE(inner);
  CHECK_EQ(inner->flows.size(), 1);
  CHECK_EQ(inner->velocities.size(), 2);
  Random random(3);
  check_identities(net, random);

  // One dashpot to ground, to a mass or to a moved node, and all of them follow from their balances.
  for (const char* anchor : {"ground", "end", "heavy"}) {
    SceneBuilder anchored = b;
    if (std::string(anchor) == "heavy") mass(anchored, "heavy");
    dashpot(anchored, "anchor", "n2", anchor);
    const Analysed viscous(anchored);
    CHECK(viscous.structure.groups.empty());
    for (const char* name : {"n1", "n2", "n3"}) CHECK(viscous.kind(name) == Kind::viscous);
    check_identities(viscous, random);
  }
}

TEST_CASE("a mass or a motion stops what dashpots lead to") {
  SceneBuilder b;
  mass(b, "m1");
  dashpot(b, "c1", "m1", "n1");
  spring(b, "k1", "n1", "n2");
  mass(b, "m2");
  spring(b, "k2", "n2", "m2");
  dashpot(b, "c2", "m2", "ground");
  const Analysed net(b);
  CHECK(net.kind("m1") == Kind::massive);
  CHECK(net.kind("m2") == Kind::massive);
  CHECK(net.kind("n1") == Kind::viscous);
  CHECK(net.kind("n2") == Kind::floating);
  Random random(4);
  check_identities(net, random);
}

TEST_CASE("masses at one node add up, and a motion goes before them") {
  SceneBuilder b;
  b.at("one", "mass", "a", {{"mass", 0.31}});
  b.at("two", "mass", "a", {{"mass", 1.23}});
  b.at("three", "mass", "b", {{"mass", 0.57}});
  b.at("four", "mass", "ground", {{"mass", 4.1}});
  drive(b, "b");
  spring(b, "k1", "a", "b");
  const Analysed net(b);
  CHECK(net.kind("a") == Kind::massive);
  CHECK_EQ(net.structure.mass[at(net.node("a"))], doctest::Approx(1.54).epsilon(1e-15));
  CHECK(net.kind("b") == Kind::known);
  CHECK_EQ(net.structure.mass[at(net.node("b"))], 0.57);
  CHECK_EQ(net.structure.motion[at(net.node("b"))], 0);
  CHECK_EQ(net.structure.motion[at(net.node("a"))], -1);
  CHECK(net.kind("ground") == Kind::known);
}

TEST_CASE("what lies between prescribed nodes is driven, unless it creeps") {
  SceneBuilder b;
  drive(b, "a");
  drive(b, "c");
  spring(b, "k1", "a", "c");
  b.between("v1", "vfm", "a", "ground", {{"damping", B}, {"stiffness", k}});
  spring(b, "k2", "c", "ground");
  const Analysed net(b);
  CHECK(net.structure.driven[at(net.branch("k1"))]);
  CHECK(net.structure.driven[at(net.branch("k2"))]);
  CHECK_FALSE(net.structure.driven[at(net.branch("v1"))]);
  REQUIRE_EQ(net.structure.closing.size(), 1);
  CHECK(net.loop("v1"));
  Random random(5);
  check_identities(net, random);
}

TEST_CASE("a massless node held by a given force and a spring floats") {
  SceneBuilder b;
  spring(b, "k1", "n1", "ground");
  b.force("push", "n1", Signal(Signal::Constant{3.7}));
  const Analysed net(b);
  CHECK(net.kind("n1") == Kind::floating);
  CHECK_EQ(net.group_of("n1").tree_branch, net.branch("k1"));
  CHECK(net.structure.closing.empty());
  CHECK_EQ(net.network.forces.at(0).b, -1);
}

TEST_CASE("structure of a mesh: every identity, for generated networks") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    SceneBuilder b;
    const int nodes = 2 + random.below(9);
    const auto name = [](int n) { return n == 0 ? std::string("ground") : "n" + std::to_string(n); };
    for (int n = 1; n <= nodes; ++n) {
      // A tree of springs and the like first, so that every node is held; then anything between any two.
      const char* const types[] = {"spring", "vfm", "dashpot"};
      const char* const type = types[random.below(3)];
      const std::string e = "t" + std::to_string(n), other = name(random.below(n));
      const bool forward = random.below(2) == 0;
      const std::string &a = forward ? name(n) : other, &c = forward ? other : name(n);
      if (std::string(type) == "spring") spring(b, e, a, c);
      if (std::string(type) == "dashpot") dashpot(b, e, a, c);
      if (std::string(type) == "vfm") b.between(e, type, a, c, {{"damping", B}, {"stiffness", k}});
      if (random.below(4) == 0) mass(b, name(n));
      if (random.below(6) == 0) drive(b, name(n));
      b.force("load" + std::to_string(n), name(n), Signal(Signal::Constant{0}));  // none of them hangs free
    }
    const int more = random.below(2 * nodes);
    for (int extra = 0; extra < more; ++extra) {
      const int one = random.below(nodes + 1), two = random.below(nodes + 1);
      if (one != two) (random.below(2) ? spring : dashpot)(b, "x" + std::to_string(extra), name(one), name(two));
    }
    const Analysed net(b);
    check_identities(net, random);
  }
}

TEST_CASE("nodes whose motion nothing determines are named, with what would mend it") {
  SceneBuilder b;
  drive(b, "end");
  spring(b, "k0", "end", "held");
  spring(b, "k1", "loose1", "loose2");
  dashpot(b, "c1", "loose2", "loose3");
  CHECK_EQ(
      refusal(b),
      "nothing determines the motion of nodes `loose1`, `loose2`, `loose3`: no mass there, and no element that resists "
      "motion leads from there to ground, to a mass or to a prescribed motion; add one, or a mass");
  mass(b, "loose3");
  CHECK_EQ(refusal(b), "");

  SceneBuilder lonely;
  lonely.force("push", "n1", Signal(Signal::Constant{1.7}));
  CHECK_EQ(
      refusal(lonely),
      "nothing determines the motion of node `n1`: no mass there, and no element that resists motion leads from there "
      "to ground, to a mass or to a prescribed motion; add one, or a mass");

  SceneBuilder misspelt;
  mass(misspelt, "weight");
  misspelt.force("pull", "weigth", Signal(Signal::Constant{1.7}));
  CHECK(refusal(misspelt).find("add one, or a mass; did you mean `weight`?") != std::string::npos);

  SceneBuilder many;
  for (int n = 1; n <= 7; ++n)
    spring(many, "k" + std::to_string(n), "n" + std::to_string(n), "n" + std::to_string(n + 1));
  CHECK(refusal(many).find("nodes `n1`, `n2`, `n3`, `n4`, `n5` and 3 more:") != std::string::npos);
}

TEST_CASE("two motions of one node are named, and one of ground is refused") {
  SceneBuilder b;
  drive(b, "end");
  b.motion("other", "end", "position", Signal(Signal::Constant{0.3}));
  spring(b, "k1", "end", "ground");
  CHECK_EQ(refusal(b), "motions `motion of end` and `other` both prescribe node `end`; leave one out");

  SceneBuilder moved;
  drive(moved, "ground");
  CHECK_EQ(refusal(moved), "motion `motion of ground` moves `ground`, which never moves; prescribe another node");
}

}  // namespace rheonet::test::structure_test
