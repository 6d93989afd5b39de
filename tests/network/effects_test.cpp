#include "core/network/effects.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/network/component.hpp"
#include "tests/contract/situation.hpp"
#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::effects_test {

namespace {

/// A mass on a spring, dragged by an oscillating wall through the given friction.
std::string dragged(const std::string& friction, const std::string& table = "") {
  return "[elements]\nwall = { type = \"motion\", at = \"wall\", velocity = { sine = \"0.3 m/s\", frequency = \"1.3 Hz\" } }\n"
         "block = { type = \"mass\", at = \"block\", mass = \"0.7 kg\" }\n"
         "k1 = { type = \"spring\", between = [\"block\", \"ground\"], stiffness = \"90 N/m\" }\n"
         "brake = { between = [\"wall\", \"block\"], " + friction + " }\n" + table +
         "\n[simulate]\nstop = 1.7\noutput = { points = 35 }\nrecord = [\"block.position\", \"block.velocity\", \"brake.force\", \"k1.force\"]\n";
}

std::string without(const std::string& list) { return "[effects]\nwithout = [" + list + "]"; }

/// Every digit of both runs is the same.
void check_same(const std::string& reduced, const std::string& written) {
  const RunTable found = simulate(reduced), expected = simulate(written);
  for (const std::string& column : expected.header) {
    CAPTURE(column);
    CHECK(found[column] == expected[column]);
  }
  CHECK(expected.scale("block.position") > 1e-6);
}

const std::string vfm = "type = \"vfm\", damping = 5, stiffness = 40, delay = 0.02";
const std::string sfm = "type = \"sfm\", stiffness = 300, coulomb = 1.1, exponent = 1";
const std::string cfm = "type = \"cfm\", stiffness = 300, coulomb = 1.1, damping = 20";

}  // namespace

TEST_CASE("an element without an effect is the law of that limit") {
  check_same(dragged(vfm, without("\"delay\"")), dragged("type = \"vfm\", damping = 5, stiffness = 40"));
  check_same(dragged(vfm, without("\"elasticity:brake\"")), dragged("type = \"dashpot\", damping = 5"));
  check_same(dragged(sfm, without("\"elasticity:brake\"")), dragged("type = \"slider\", coulomb = 1.1"));
  check_same(dragged(cfm, without("\"dry_friction\"")), dragged("type = \"vfm\", damping = 20, stiffness = 300"));
  check_same(dragged(cfm, without("\"viscosity\"")), dragged("type = \"sfm\", stiffness = 300, coulomb = 1.1"));
  check_same(dragged(cfm, without("\"viscosity\", \"elasticity:brake\"")), dragged("type = \"slider\", coulomb = 1.1"));
  check_same(dragged(cfm, without("\"dry_friction\", \"elasticity:brake\"")), dragged("type = \"dashpot\", damping = 20"));
}

TEST_CASE("without all that makes its force an element has none") {
  const std::string preload = "[nodes]\nblock = { position = 0.01 }\n";
  for (const auto& [friction, list] : {std::pair{vfm, "\"viscosity\""}, std::pair{sfm, "\"dry_friction\""},
                                       std::pair{cfm, "\"dry_friction\", \"viscosity\""}}) {
    CAPTURE(friction);
    const RunTable found = simulate(dragged(friction, preload + without(list)));
    CHECK_EQ(found.scale("brake.force"), 0);
    const double omega = std::sqrt(90 / 0.7);
    for (std::size_t k = 0; k < found.time().size(); ++k) {
      CHECK(std::abs(found["block.position"][k] - 0.01 * std::cos(omega * found.time()[k])) < 1e-8);
    }
  }
}

TEST_CASE("without inertia a mass is not there") {
  // The spring takes the force that the vfm transmits; the block moves to where they balance.
  const RunTable found = simulate(dragged("type = \"dashpot\", damping = 5", without("\"inertia\"")));
  for (std::size_t k = 0; k < found.time().size(); ++k) CHECK(std::abs(found["brake.force"][k] - found["k1.force"][k]) < 1e-6);
  CHECK(found.scale("k1.force") > 0.5);
}

TEST_CASE("without elasticity a spring is a rigid link") {
  const std::string pulled = R"([elements]
pull = { type = "force", at = "a", force = { sine = "3 N", frequency = "1 Hz" } }
k1 = { type = "spring", between = ["a", "b"], stiffness = 50 }
m1 = { type = "mass", at = "b", mass = 2 }
c1 = { type = "dashpot", between = ["b", "ground"], damping = 1 }
[effects]
without = ["elasticity"]
[simulate]
stop = 2
record = ["a.velocity", "b.velocity", "k1.force"]
)";
  const RunTable found = simulate(pulled);
  CHECK(found["a.velocity"] == found["b.velocity"]);
  for (std::size_t k = 0; k < found.time().size(); ++k)
    CHECK(std::abs(found["k1.force"][k] - 3 * std::sin(2 * M_PI * found.time()[k])) < 1e-5);
}

TEST_CASE("without feedback blocks see a network that stands still") {
  const auto servo = [](const std::string& table) {
    return R"([elements]
command = { type = "generator", signal = "3 m/s" }
error = { type = "sum", in = ["command", "-cart.velocity"] }
drive = { type = "gain", in = "error", gain = "4 N*s/m" }
motor = { type = "force", at = "cart", force = { block = "drive" } }
cart = { type = "mass", at = "cart", mass = 2 }
look = { type = "gain", in = "cart.velocity", gain = 10 }
)" + table + "[simulate]\nstop = 1\noutput = { points = 11 }\nrecord = [\"cart.velocity\", \"look.out\"]\n";
  };
  const RunTable closed = simulate(servo("")), open = simulate(servo("[effects]\nwithout = [\"feedback\"]\n"));
  for (std::size_t k = 0; k < closed.time().size(); ++k) {
    const double t = closed.time()[k];
    CHECK(std::abs(closed["cart.velocity"][k] - 3 * (1 - std::exp(-2 * t))) < 1e-5);
    CHECK(std::abs(open["cart.velocity"][k] - 6 * t) < 1e-5);
    CHECK(std::abs(open["look.out"][k] - 60 * t) < 1e-4);  // it acts on nothing
  }
}

TEST_CASE("an effect that a law cannot do without by itself is refused") {
  CHECK(refusal(dragged(cfm, without("\"elasticity:brake\""))).find("the elasticity of `brake` cannot be left out by itself: a `cfm` with "
                                                                      "dry friction and viscosity alone has no law") != std::string::npos);
}

TEST_CASE("a cfm at a limit of its parameters does without effects as the model of that limit does") {
  const std::string rest = "stiffness = 300, exponent = 0.8";
  struct { std::string cfm, model; } const limits[] = {
      {"damping = \"inf\", coulomb = 2", "type = \"sfm\", coulomb = 2, " + rest},
      {"damping = 5, coulomb = \"inf\"", "type = \"vfm\", damping = 5, stiffness = 300"},
      {"damping = \"inf\", coulomb = \"inf\"", "type = \"spring\", stiffness = 300"}};
  for (const auto& [parameters, model] : limits) {
    for (const std::string effect : {"elasticity", "viscosity", "dry_friction"}) {
      CAPTURE(parameters);
      CAPTURE(effect);
      const std::string out = without("\"" + effect + ":brake\"");
      const RunTable limit = simulate(dragged("type = \"cfm\", " + parameters + ", " + rest, out)), same = simulate(dragged(model, out));
      for (std::size_t k = 0; k < same.time().size(); ++k)
        CHECK(std::abs(limit["brake.force"][k] - same["brake.force"][k]) <= 1e-6 * same.scale("brake.force"));
    }
  }
}

TEST_CASE("contract: every effect that a component declares can be left out, but for those it says cannot by themselves") {
  int tried = 0;
  for (const Component* component : components()) {
    const Declaration& d = component->declaration;
    CAPTURE(d.type);
    std::set<Effect> declared;
    std::set<std::pair<Effect, std::string>> by;
    for (const Brought& b : d.effects) {
      declared.insert(b.effect);
      CHECK(by.insert({b.effect, b.parameter}).second);
      const auto p = std::find_if(d.parameters.begin(), d.parameters.end(), [&](const Parameter& q) { return q.name == b.parameter; });
      REQUIRE(p != d.parameters.end());
      if (b.absent) CHECK((std::isinf(*b.absent) ? p->may_be_infinite : (p->lower_open ? *b.absent > p->lower : *b.absent >= p->lower) && *b.absent <= p->upper));
    }
    for (const Absence& a : d.absences) {
      for (const Effect effect : a.effects) CHECK(declared.contains(effect));
    }
  }
  for (const Case& c : cases()) {
    const Declaration& d = c.component->declaration;
    Scene scene;
    SceneElement element{.name = "e", .spot = {}, .values = c.values, .given = {}, .signals = {}, .signal_parameters = {}, .characteristics = {}};
    element.declaration = static_cast<int>(std::find(components().begin(), components().end(), c.component) - components().begin());
    for (const Brought& b : d.effects) {
      const std::vector<Effect> before = brought_by(element);
      if (!b.absent || std::find(before.begin(), before.end(), b.effect) == before.end()) continue;
      scene.without = {{b.effect}};
      SceneElement rest = element;
      leave_out_effects(scene, element, rest.values.own());
      const std::vector<Effect> after = brought_by(rest);
      CHECK(std::find(after.begin(), after.end(), b.effect) == after.end());
      CHECK(after.size() < before.size());
      ++tried;
    }
  }
  CHECK(tried > 10);
}

}  // namespace rheonet::test::effects_test
