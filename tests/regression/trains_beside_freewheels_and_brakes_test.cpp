// Starts and loads of gears beside elements that hold one direction, or little: where they were refused, or held more than they can.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::trains_beside_freewheels_and_brakes_test {

TEST_CASE("start velocities that a gear and a freewheel together change have one common momentum") {
  const std::string planetary = R"([elements]
sun = { type = "inertia", at = "sun", inertia = 0.6136 }
carrier = { type = "inertia", at = "carrier", inertia = 5.319 }
ring = { type = "inertia", at = "ring", inertia = 0.6347 }
free = { type = "freewheel", between = ["sun", "carrier"] }
set = { type = "planetary", between = ["sun", "carrier", "ring"], ratio = 2.59 }
[nodes]
carrier = { velocity = -0.539 }
ring = { velocity = 1.05 }
[simulate]
stop = 4
output = { points = 3 }
)";
  const double together = (-0.539 * 5.319 + 1.05 * 0.6347) / (0.6136 + 5.319 + 0.6347);
  for (const char* node : {"sun", "carrier", "ring"}) CHECK_LE(std::abs(simulate(scene_of(planetary))[fmt::format("{}.velocity", node)].back() - together), 1e-13);

  const std::string geared = R"([elements]
motor = { type = "inertia", at = "motor", inertia = 0.2049 }
shaft = { type = "inertia", at = "shaft", inertia = 0.1211 }
fan = { type = "inertia", at = "fan", inertia = 3.847 }
gear = { type = "gear", between = ["motor", "shaft"], ratio = 2.1 }
free = { type = "freewheel", between = ["shaft", "fan"] }
[nodes]
motor = { velocity = -1.32 }
shaft = { velocity = 1.11 }
[simulate]
stop = 4
output = { points = 3 }
)";
  const double common = (2.1 * 0.2049 * -1.32 + 0.1211 * 1.11) / (2.1 * 2.1 * 0.2049 + 0.1211 + 3.847);
  for (const char* node : {"shaft", "fan"}) CHECK_LE(std::abs(simulate(scene_of(geared))[fmt::format("{}.velocity", node)].back() - common), 1e-13);
}

TEST_CASE("a gear with losses drives against brakes of any strength") {
  // The brake at the load takes 1.128 N m of the torque. The gear divides the rest by its ratio, and loses its share.
  const double arrives = 0.417 * (1.333 - 1.128) / 2.93;
  for (const double brake : {1e-12, 1e-9, 1e-4, 0.02, 0.0291, 0.0293, 1.0}) {
    const std::string text = fmt::format(R"([elements]
rotor = {{ type = "inertia", at = "rotor", inertia = 3.458 }}
gear = {{ type = "gear", between = ["rotor", "load"], ratio = 2.93, efficiency = 0.417 }}
load_brake = {{ type = "slider", between = ["load", "ground"], coulomb = 1.128 }}
rotor_brake = {{ type = "slider", between = ["rotor", "ground"], coulomb = {:g} }}
torque = {{ type = "torque", at = "load", torque = 1.333 }}
[simulate]
stop = 4
output = {{ points = 5 }}
)", brake);
    CAPTURE(text);
    const RunTable rows = simulate(scene_of(text));
    CHECK_LE(std::abs(rows["rotor.velocity"].back() - std::max(0.0, arrives - brake) / 3.458 * 4), 1e-12);
    for (const double force : rows["load_brake.force"]) CHECK_LE(std::abs(force), 1.128 * (1 + 1e-12));
    for (const double force : rows["rotor_brake.force"]) CHECK_LE(std::abs(force), brake * (1 + 1e-12));
  }
}

TEST_CASE("a brake whose bound rises from 0 on slips at once") {
  const std::string text = R"([elements]
rotor = { type = "inertia", at = "rotor", inertia = 3.458 }
gear = { type = "gear", between = ["rotor", "load"], ratio = 2.93, efficiency = 0.417 }
load_brake = { type = "slider", between = ["load", "ground"], coulomb = 1.128 }
rotor_brake = { type = "slider", between = ["rotor", "ground"], coulomb = { ramp = 0.02 } }
torque = { type = "torque", at = "load", torque = 1.333 }
[simulate]
stop = 1
output = { points = 3 }
)";
  const double arrives = 0.417 * (1.333 - 1.128) / 2.93;
  CHECK_LE(std::abs(simulate(scene_of(text))["rotor.velocity"].back() - (arrives - 0.01) / 3.458), 1e-12);
}

TEST_CASE("a slider that comes to rest within 1e-12 s of breaking away again sticks until then") {
  // The force rises to 1 N within 1e-12 s, and falls to -1 N within as long.
  const std::string text = R"([elements]
m = { type = "mass", at = "a", mass = 1 }
f = { type = "force", at = "a", force = { table = [[0, 0], [1, 0], [1.000000000001, 1], [1.000000000002, -1], [2, -1]] } }
s = { type = "slider", between = ["a", "ground"], coulomb = 0.5 }
k = { type = "spring", between = ["a", "ground"], stiffness = 10 }
[simulate]
stop = 1.5
output = { points = 4 }
)";
  for (const auto method : {Scene::Method::exact, Scene::Method::ida}) {
    Scene scene = scene_of(text, 1e-9);
    scene.method = method;
    CHECK_LE(std::abs(simulate(scene)["a.position"].back() + 0.05 * (1 - std::cos(std::sqrt(10.0) * 0.5))), 1e-9);
  }
}

}  // namespace rheonet::test::trains_beside_freewheels_and_brakes_test
