#include "core/network/network.hpp"

#include <doctest/doctest.h>

#include "core/network/error.hpp"
#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::network_test {

namespace {

Scene finish(const SceneBuilder& builder) { return builder.finish(0.37, 10, 1e-6); }

std::string refusal(const SceneBuilder& builder) {
  const Scene scene = finish(builder);
  try {
    build_network(scene);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("laws are sorted into one contiguous batch a type, and every element knows its place") {
  SceneBuilder b;
  b.between("s1", "spring", "a", "ground", {{"stiffness", 11.3}});
  b.between("v1", "vfm", "a", "b", {{"damping", 1.7}, {"stiffness", 23.1}});
  b.between("c1", "dashpot", "a", "b", {{"damping", 0.7}});
  b.between("s2", "spring", "b", "a", {{"stiffness", 31.7}});
  b.at("m1", "mass", "b", {{"mass", 0.19}});
  b.between("c2", "dashpot", "b", "ground", {{"damping", 1.3}, {"flow_index", 1.7}});
  b.motion("drive", "a", "position", Signal(Signal::Constant{0.3}));
  b.force("push", "b", Signal(Signal::Constant{0.7}));
  b.force("pull", "b", "a", Signal(Signal::Constant{0.9}));
  const Scene scene = finish(b);
  const Network net = build_network(scene);

  REQUIRE_EQ(net.deflections.size(), 3);
  REQUIRE_EQ(net.deflection_laws.size(), 2);
  REQUIRE_EQ(net.rates.size(), 2);
  REQUIRE_EQ(net.rate_laws.size(), 1);
  for (const Laws<DeflectionBatch>& laws : net.deflection_laws) {
    const std::string& type = laws.component->declaration.type;
    CHECK_EQ(laws.batch->size(), type == "spring" ? 2 : 1);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& branch = net.deflections[static_cast<std::size_t>(laws.first) + i];
      const SceneElement& e = scene.elements[static_cast<std::size_t>(branch.element)];
      CHECK_EQ(declarations()[static_cast<std::size_t>(e.declaration)]->type, type);
      CHECK_EQ(branch.a, e.a);
      CHECK_EQ(branch.b, e.b);
    }
  }
  REQUIRE_EQ(net.places.size(), scene.elements.size());
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const Network::Place& place = net.places[e];
    const int element = static_cast<int>(e);
    const auto index = static_cast<std::size_t>(place.index);
    switch (place.role) {
      case Role::inerter:
        CHECK_EQ(net.inerters.at(index).branch.element, element);
        break;
      case Role::train:
        CHECK_EQ(net.trains.at(index).element, element);
        break;
      case Role::deflection:
        CHECK_EQ(net.deflections.at(index).element, element);
        break;
      case Role::rate:
        CHECK_EQ(net.rates.at(index).element, element);
        break;
      case Role::slip:
        CHECK_EQ(net.sliders.at(index).branch.element, element);
        break;
      case Role::mass:
        CHECK_EQ(net.masses.at(index).element, element);
        CHECK_EQ(net.masses.at(index).mass, 0.19);
        break;
      case Role::motion:
        CHECK_EQ(net.motions.at(index).element, element);
        CHECK(net.motions.at(index).position);
        break;
      case Role::force:
        CHECK_EQ(net.forces.at(index).element, element);
        CHECK_EQ(net.forces.at(index).b, scene.elements[e].at ? -1 : b.node("a"));
        break;
      case Role::block:
      case Role::nothing:
        FAIL("no element here is nothing, or a block");
    }
  }
  CHECK(net.notes.empty());

  // The values reach the law of their own element, not of a neighbour in the batch.
  const auto force = [&](const std::string& name, double p) {
    for (const Laws<DeflectionBatch>& laws : net.deflection_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        if (net.name_of(net.deflections[static_cast<std::size_t>(laws.first) + i]) != name) continue;
        std::vector<double> all(laws.batch->size(), p), f(all), c(all);
        laws.batch->evaluate(all.data(), f.data(), c.data());
        return f[i];
      }
    }
    return 0.0;
  };
  CHECK_EQ(force("s1", 0.37), 11.3 * 0.37);
  CHECK_EQ(force("s2", 0.37), 31.7 * 0.37);
  CHECK_EQ(force("v1", 0.37), 23.1 * 0.37);
}

TEST_CASE("elements with a parameter of 0 become nothing, and a note says which") {
  SceneBuilder b;
  b.between("k0", "spring", "a", "b", {{"stiffness", 0}});
  b.between("c0", "dashpot", "a", "b", {{"damping", 0}});
  b.between("f0", "sfm", "a", "b", {{"stiffness", 31.0}, {"coulomb", 0}});
  b.between("v0", "vfm", "a", "b", {{"stiffness", 0}, {"damping", 1.7}});
  b.between("x0", "cfm", "a", "b", {{"stiffness", 31.0}, {"coulomb", 3.1}, {"damping", 0}});
  b.at("m0", "mass", "b", {{"mass", 0}});
  b.between("k1", "spring", "b", "ground", {{"stiffness", 7.3}});
  b.force("load", "b", Signal(Signal::Constant{0}));
  b.motion("drive", "a", "velocity", Signal(Signal::Constant{0.3}));
  const Scene scene = finish(b);
  const Network net = build_network(scene);
  CHECK_EQ(net.deflections.size(), 1);
  CHECK(net.rates.empty());
  CHECK(net.masses.empty());
  REQUIRE_EQ(net.notes.size(), 6);
  for (const char* name : {"k0", "c0", "f0", "v0", "x0", "m0"}) {
    bool noted = false;
    for (const std::string& note : net.notes) {
      noted = noted || note == "element `" + std::string(name) + "` carries no force: a parameter of it is 0";
    }
    CHECK_MESSAGE(noted, name);
  }
  // The element still has ends, and a force of 0.
  const RunTable run = simulate(scene);
  CHECK_EQ(run.scale("k0.force"), 0);
  CHECK_EQ(run["k0.displacement"].back(), doctest::Approx(0.3 * 0.37).epsilon(1e-12));
  CHECK_EQ(run["c0.velocity"].back(), doctest::Approx(0.3).epsilon(1e-12));
}

// Each node has one place in the order, however many elements name it: a count of them once went round at 256.
TEST_CASE("a node at which hundreds of elements meet is one node") {
  for (const int count : {255, 256, 257, 600}) {
    SceneBuilder b;
    for (int i = 0; i < count; ++i) {
      const std::string name = std::to_string(i);
      b.between("k" + name, "spring", "x", "n" + name, {{"stiffness", 7.3}});
      b.between("c" + name, "dashpot", "n" + name, "ground", {{"damping", 1.7}});
    }
    b.motion("drive", "x", "velocity", Signal(Signal::Constant{0.3}));
    const Scene scene = b.finish(1, 10, 1e-6);
    CHECK_EQ(build_network(scene).node_order.size(), static_cast<std::size_t>(count) + 2);
  }
}

TEST_CASE("an element with both ends at one node is refused by name") {
  SceneBuilder b;
  b.between("k1", "spring", "a", "a", {{"stiffness", 7.3}});
  CHECK_EQ(
      refusal(b),
      "element `k1`: both ends are at node `a`, so that it can do nothing; connect one end elsewhere or leave it out");
}

}  // namespace rheonet::test::network_test
