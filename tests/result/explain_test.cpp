#include "core/result/explain.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/simulate.hpp"

namespace rheonet::test::explain_test {

using Names = std::vector<std::string>;

namespace {

const Explanation::EffectFound& effect(const Explanation& e, Effect which) {
  return *std::find_if(e.effects.begin(), e.effects.end(), [&](const auto& f) { return f.effect == which; });
}

/// The names of a line that is left out, by how it begins and by its reduction.
Names left_out(const Explanation& e, const std::string& what, const std::string& reduction) {
  for (const Explanation::Omission& o : e.left_out) {
    if (o.what == what && o.reduction == reduction) return o.names;
  }
  return {};
}

Names unknown(const Explanation& e, const std::string& quantity, bool differential) {
  for (const Explanation::Unknowns& u : e.unknowns) {
    if (u.quantity == quantity && u.differential == differential) return u.names;
  }
  return {};
}

// A drive pulls a mass through a spring; a Maxwell element holds it. Beside it, a spring and a slider alone.
const std::string scene = R"([elements]
hand = { type = "motion", at = "grip", velocity = { square = "0.1 m/s", frequency = "2 Hz" } }
k1 = { type = "spring", between = ["grip", "block"], stiffness = 100 }
m1 = { type = "mass", at = "block", mass = 1 }
k2 = { type = "spring", between = ["block", "mid"], stiffness = 50 }
c2 = { type = "dashpot", between = ["mid", "ground"], damping = 5 }
k3 = { type = "spring", between = ["grip", "rub"], stiffness = 70 }
s3 = { type = "slider", between = ["rub", "ground"], coulomb = 1 }
k4 = { type = "spring", between = ["grip", "ground"], stiffness = 10 }
)";
const std::string simulated = "[simulate]\nstop = 2\nrecord = [\"k1.force\"]\n";

}  // namespace

TEST_CASE("an explanation names who brings each effect, and who does not on demand") {
  const Explanation e = explain(scene_of(scene + "[effects]\nwithout = [\"elasticity:k2\"]\n" + simulated));
  CHECK(effect(e, Effect::inertia).by == Names{"m1"});
  CHECK(effect(e, Effect::elasticity).by == Names{"k1", "k3", "k4"});
  CHECK(effect(e, Effect::elasticity).left_out == Names{"k2"});
  CHECK(effect(e, Effect::viscosity).by == Names{"c2"});
  CHECK(effect(e, Effect::dry_friction).by == Names{"s3"});
  CHECK(effect(e, Effect::delay).by.empty());
  CHECK(effect(e, Effect::feedback).by.empty());
}

TEST_CASE("an explanation lists the unknowns and what determines them, and what is none and why") {
  const Explanation e = explain(scene_of(scene + simulated));
  CHECK(unknown(e, "velocity", true) == Names{"block"});
  CHECK(unknown(e, "velocity", false) == Names{"mid"});
  CHECK(unknown(e, "deflection", true) == Names{"k1", "k2"});
  CHECK_EQ(e.structure.differential + e.structure.algebraic, e.cost.unknowns);
  CHECK(left_out(e, "node", "bundles") == Names{"rub"});
  CHECK(left_out(e, "deflection of", "given") == Names{"s3"});  // The spring has the name of its slider.
  CHECK(left_out(e, "position of", "positions") == Names{"block", "mid"});
  CHECK(left_out(e, "element", "unasked") == Names{"k4"});
  CHECK(left_out(e, "motion of", "") == Names{"grip"});
}

TEST_CASE("what is kept is an unknown") {
  Scene kept = scene_of(scene + simulated);
  kept.keep = {"given", "positions", "bundles", "unasked"};
  const Explanation e = explain(kept);
  CHECK(unknown(e, "deflection", true) == Names{"k1", "k2", "k3", "k4"});
  CHECK(left_out(e, "position of", "") == Names{"mid", "rub"});  // they follow from deflections
  CHECK(unknown(e, "position", true) == Names{"block"});          // its motion may be small beside that of the grip
  CHECK(left_out(e, "element", "unasked").empty());
  CHECK(left_out(e, "node", "bundles").empty());
  CHECK(left_out(e, "deflection of", "given").empty());
  CHECK(left_out(e, "position of", "positions").empty());
  // A position behind a dashpot follows from nothing.
  const std::string dragged = "[elements]\nd = { type = \"motion\", at = \"hand\", velocity = 1 }\nc = { type = \"dashpot\", between = [\"hand\", "
                              "\"sled\"], damping = 2 }\nm = { type = \"mass\", at = \"sled\", mass = 1 }\n[simulate]\nstop = 1\nrecord = [\"c.force\"]\n";
  Scene sled = scene_of(dragged);
  CHECK(unknown(explain(sled), "position", true).empty());
  sled.keep = {"positions"};
  CHECK(unknown(explain(sled), "position", true) == Names{"sled"});
}

TEST_CASE("structure: the index as wired and as solved, and the parts") {
  const Explanation::Structure s = explain(scene_of(scene + simulated)).structure;
  CHECK_EQ(s.index_as_wired, 1);
  CHECK_EQ(s.index, 1);
  CHECK_EQ(s.parts, 3);  // the mass with its Maxwell element; the spring with its slider; the spring alone
  // Two springs in series: a balance of forces that says nothing of the velocity between them.
  const Explanation::Structure springs = explain(scene_of(R"([elements]
hand = { type = "motion", at = "grip", velocity = 1 }
k1 = { type = "sfm", between = ["grip", "mid"], stiffness = 100, coulomb = 1 }
k2 = { type = "spring", between = ["mid", "ground"], stiffness = 100 }
[simulate]
stop = 1
)")).structure;
  CHECK_EQ(springs.index_as_wired, 2);
  CHECK_EQ(springs.index, 1);
  CHECK_EQ(springs.parts, 1);
  const Explanation::Structure oscillator = explain(scene_of(R"([elements]
m1 = { type = "mass", at = "block", mass = 1 }
k1 = { type = "spring", between = ["block", "ground"], stiffness = 100 }
[nodes]
block = { position = 1 }
[simulate]
stop = 1
)")).structure;
  CHECK_EQ(oscillator.index_as_wired, 0);
  CHECK_EQ(oscillator.index, 0);
}

TEST_CASE("events that can occur, and instants that are known") {
  const Explanation e = explain(scene_of(scene + simulated));
  REQUIRE_EQ(e.events.size(), 2);
  CHECK_EQ(e.events[0].kinds, "stick, slip, reversal");
  CHECK(e.events[0].names == Names{"s3"});
  CHECK(e.events[1].names == Names{"hand"});
  CHECK_EQ(e.cost.known_instants, 7);  // a square of 2 Hz in 2 s, without its start and its end
}

TEST_CASE("a run that is over while it is tried is predicted to the step") {
  Scene s = scene_of(scene + simulated);
  s.method = Scene::Method::ida;
  const Explanation::Cost cost = explain(s).cost;
  if (cost.tried == 1) CHECK_EQ(cost.steps, run(s).steps);
  CHECK(cost.steps > 50);
  CHECK(cost.seconds() > 0);
}

}  // namespace rheonet::test::explain_test
