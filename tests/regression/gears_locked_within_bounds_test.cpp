// Brakes, freewheels and losses lock a gear together. Each holds only as much as its bound allows. A search that first shared the load
// without these bounds ended in "it cannot be decided what slips". A search that followed the losses from one trial to the next shared a load
// with a gear that can hold none of it, where a worm gear beside it holds all.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::gears_locked_within_bounds_test {

namespace {

struct Locked {
  const char* what;
  std::string elements;
  std::string simulate = {};
};

const char* const just_holds = R"(
J0 = { type = "inertia", at = "a", inertia = 1 }
J1 = { type = "inertia", at = "b", inertia = 2 }
J2 = { type = "inertia", at = "c", inertia = 2 }
gear = { type = "gear", between = ["a", "b"], ratio = 2, efficiency = [0.9272, 0.2123] }
worm = { type = "gear", between = ["c", "b"], ratio = 1, efficiency = [0.7663, 0] }
push = { type = "torque", at = "b", torque = { sine = 1, frequency = 1 } }
)";

const char* const winds_up = R"(
first = { type = "inertia", at = "a", inertia = 1 }
second = { type = "inertia", at = "b", inertia = 2 }
worm = { type = "gear", between = ["a", "b"], ratio = -0.9, efficiency = [0.4098, 0] }
free = { type = "freewheel", between = ["a", "ground"] }
shaft = { type = "spring", between = ["b", "ground"], stiffness = 34 }
push = { type = "torque", at = "a", torque = { triangle = 3, frequency = 4 } }
)";

/// Gears that all slip, or all hold: `{}` is the torque.
const char* const all_or_none = R"(
J0 = {{ type = "inertia", at = "a", inertia = 1 }}
J1 = {{ type = "inertia", at = "b", inertia = 1 }}
J2 = {{ type = "inertia", at = "c", inertia = 1 }}
J3 = {{ type = "inertia", at = "d", inertia = 1 }}
gear1 = {{ type = "gear", between = ["a", "b"], ratio = 1, efficiency = 0.5 }}
gear2 = {{ type = "gear", between = ["b", "d"], ratio = 1, efficiency = 0.5 }}
gear3 = {{ type = "gear", between = ["a", "c"], ratio = 1, bearing = 0.3 }}
brake = {{ type = "slider", between = ["d", "ground"], coulomb = 0.6 }}
push = {{ type = "torque", at = "b", torque = {} }}
)";

const char* const beyond = R"(
J0 = { type = "inertia", at = "a", inertia = 2 }
J1 = { type = "inertia", at = "b", inertia = 0.5 }
J2 = { type = "inertia", at = "c", inertia = 1 }
gear = { type = "gear", between = ["a", "b"], ratio = 1, efficiency = 0.7, bearing = 0.3 }
worm = { type = "gear", between = ["a", "c"], ratio = 2, efficiency = [0.926, -0.01] }
brake = { type = "slider", between = ["c", "ground"], coulomb = 1 }
push = { type = "torque", at = "a", torque = { sine = 1, frequency = 1, offset = 0.5 } }
shake = { type = "torque", at = "c", torque = { sine = 3, frequency = 1 } }
)";

const std::vector<Locked> scenes{
    {"a rotor comes to rest between its brake and a slider to a gear that is loaded from behind", R"(
rotor = { type = "inertia", at = "a", inertia = 0.2038 }
load = { type = "inertia", at = "c", inertia = 0.4277 }
clutch = { type = "slider", between = ["a", "b"], coulomb = 0.3 }
gear = { type = "gear", between = ["b", "c"], ratio = 4.12, efficiency = 0.65 }
shaft = { type = "spring", between = ["c", "ground"], stiffness = 1.807 }
brake = { type = "slider", between = ["a", "ground"], coulomb = 1.617 }
push = { type = "torque", at = "c", torque = 1 }
kick = { type = "torque", at = "a", torque = { pulse = -40, width = 0.001 } }
)"},
    {"the brake of a gear, and the gear's losses, beside a freewheel", R"(
wheel = { type = "inertia", at = "b", inertia = 8.006 }
end = { type = "inertia", at = "c", inertia = 0.8941 }
gear = { type = "gear", between = ["a", "b"], ratio = 3.39, efficiency = 0.5 }
clutch = { type = "slider", between = ["b", "c"], coulomb = 0.3 }
free = { type = "freewheel", between = ["c", "ground"] }
brake = { type = "slider", between = ["a", "ground"], coulomb = 0.11 }
kick = { type = "torque", at = "c", torque = { pulse = -2.964, width = 0.1, frequency = 1.063 } }
push = { type = "torque", at = "b", torque = 1 }
)"},
    {"two freewheels behind a gear with a bearing, from rest", R"(
wheel = { type = "inertia", at = "b", inertia = 0.718 }
gear = { type = "gear", between = ["a", "b"], ratio = 0.316, efficiency = 0.876, bearing = 0.251 }
free1 = { type = "freewheel", between = ["b", "c"] }
free2 = { type = "freewheel", between = ["c", "d"] }
shaft = { type = "spring", between = ["d", "ground"], stiffness = 101.8 }
push = { type = "torque", at = "c", torque = { square = -3.679, frequency = 2.853 } }
)", "start_from = \"rest\""},
    {"three gears with losses in a row, turned back by a lag", R"(
wheel = { type = "inertia", at = "b", inertia = 4.157 }
gear1 = { type = "gear", between = ["a", "b"], ratio = 3.72, efficiency = 0.5 }
gear2 = { type = "gear", between = ["b", "c"], ratio = 2.34, efficiency = 0.366 }
gear3 = { type = "gear", between = ["c", "d"], ratio = 0.894, efficiency = [0.735, 0.124] }
push = { type = "torque", at = "b", torque = -3 }
turn = { type = "generator", signal = { step = 7, time = 1 } }
late = { type = "lag", in = "turn", time_constant = 0.3 }
back = { type = "torque", at = "d", torque = { block = "late" } }
)"},
    {"a planetary gear whose sun and carrier a freewheel joins", R"(
carrier = { type = "inertia", at = "carrier", inertia = 0.2938 }
load = { type = "inertia", at = "load", inertia = 0.251 }
free = { type = "freewheel", between = ["sun", "carrier"] }
clutch = { type = "slider", between = ["carrier", "ring"], coulomb = 0.3, normal = { pulse = 10.92, width = 0.1, frequency = 0.5163 } }
gear = { type = "gear", between = ["ring", "load"], ratio = -1.03 }
set = { type = "planetary", between = ["sun", "carrier", "ring"], ratio = 1.43 }
push = { type = "torque", at = "load", torque = { cosine = -3.436, frequency = 1.339, offset = -3.436 } }
)"},
    {"idle gears at a shaft that a brake holds", R"(
shaft = { type = "inertia", at = "c", inertia = 0.6537 }
gear1 = { type = "gear", between = ["a", "b"], ratio = -1.32, efficiency = 0.338 }
gear2 = { type = "gear", between = ["b", "c"], ratio = -0.483, efficiency = [0.459, -0.308] }
brake = { type = "slider", between = ["c", "ground"], coulomb = 1 }
push = { type = "torque", at = "c", torque = { ramp = -0.9166 } }
)"},
    {"a gear that hardly any force reaches yet, through a dashpot", R"(
first = { type = "inertia", at = "b", inertia = 7.772 }
second = { type = "inertia", at = "c", inertia = 0.1356 }
gear1 = { type = "gear", between = ["a", "b"], ratio = -3.09, efficiency = 0.515, bearing = 0.201 }
drag = { type = "dashpot", between = ["b", "c"], damping = 0.5009 }
gear2 = { type = "gear", between = ["c", "d"], ratio = 2.67, efficiency = 0.309 }
shaft = { type = "spring", between = ["d", "ground"], stiffness = 51.29 }
push = { type = "torque", at = "b", torque = 1 }
)"},
    {"a worm gear that just holds its load, beside a gear that can hold nothing", just_holds},
    {"two worm gears at one shaft, a torque in front of one of them", R"(
J0 = { type = "inertia", at = "a", inertia = 1.5 }
J1 = { type = "inertia", at = "b", inertia = 2 }
J2 = { type = "inertia", at = "c", inertia = 1.2 }
worm1 = { type = "gear", between = ["a", "b"], ratio = -2, efficiency = [0.6837, -0.0574] }
worm2 = { type = "gear", between = ["c", "b"], ratio = -3, efficiency = [0.811, -0.219] }
shake = { type = "torque", at = "b", torque = { sine = 2.4, frequency = 2.2, phase = 1 } }
push = { type = "torque", at = "a", torque = { table = [[0.2304, -0.1169], [0.3291, 0.0818], [0.6005, 3.9997]] } }
)"},
    {"a worm gear, driven at both ends, and a brake with breakaway behind it", R"(
first = { type = "inertia", at = "a", inertia = 1 }
second = { type = "inertia", at = "b", inertia = 1 }
worm = { type = "gear", between = ["a", "b"], ratio = 1, efficiency = [0.5583, -0.5] }
brake = { type = "slider", between = ["b", "ground"], coulomb = 0.6, breakaway = 1 }
shake = { type = "torque", at = "a", torque = { sine = 1, frequency = 2 } }
push = { type = "torque", at = "b", torque = { sine = 3, frequency = 1, offset = -1 } }
)"},
    {"a freewheel in front of a worm gear that winds up a spring", winds_up},
    {"bearings that let a shaft slip at the same load again and again, beside a worm gear without a load", R"(
first = { type = "inertia", at = "a", inertia = 1 }
second = { type = "inertia", at = "b", inertia = 1 }
gear = { type = "gear", between = ["b", "a"], ratio = 3, efficiency = [0.8467, 0.0554], bearing = 0.4361 }
third = { type = "inertia", at = "c", inertia = 2 }
worm = { type = "gear", between = ["b", "c"], ratio = -2, efficiency = [0.35, -0.5] }
free = { type = "freewheel", between = ["a", "ground"] }
push = { type = "torque", at = "a", torque = { sine = 3, frequency = 1 } }
)"},
    {"a gear that begins to slip into one that carries nothing", R"(
J0 = { type = "inertia", at = "a", inertia = 2 }
J1 = { type = "inertia", at = "b", inertia = 1 }
J2 = { type = "inertia", at = "c", inertia = 1 }
J3 = { type = "inertia", at = "d", inertia = 1 }
gear1 = { type = "gear", between = ["a", "b"], ratio = 1, efficiency = 0.7 }
gear2 = { type = "gear", between = ["a", "c"], ratio = 3, efficiency = [0.75, 0.05] }
gear3 = { type = "gear", between = ["c", "d"], ratio = 3, efficiency = 0.7 }
push = { type = "torque", at = "c", torque = { sine = 2, frequency = 1 } }
pull = { type = "torque", at = "d", torque = -2 }
)"},
    {"a worm gear that nothing drives from behind, and a gear behind it", R"(
J0 = { type = "inertia", at = "a", inertia = 1 }
J1 = { type = "inertia", at = "b", inertia = 1 }
J2 = { type = "inertia", at = "c", inertia = 1 }
worm = { type = "gear", between = ["a", "b"], ratio = -2, efficiency = [0.6057, 0] }
gear = { type = "gear", between = ["c", "b"], ratio = -1.1319, efficiency = [0.8935, 0.2479], bearing = 0.2309 }
shake = { type = "torque", at = "b", torque = { triangle = 2, frequency = 2 } }
push = { type = "torque", at = "a", torque = { sine = 3, frequency = 3, offset = -1 } }
)"},
    {"a worm gear whose bearings help a small load from behind", R"(
J0 = { type = "inertia", at = "a", inertia = 1 }
J1 = { type = "inertia", at = "b", inertia = 2 }
J2 = { type = "inertia", at = "c", inertia = 0.5 }
J3 = { type = "inertia", at = "d", inertia = 2 }
worm = { type = "gear", between = ["b", "a"], ratio = 3, efficiency = [0.424, -0.318], bearing = 0.3 }
gear1 = { type = "gear", between = ["a", "c"], ratio = -2, efficiency = 0.7 }
gear2 = { type = "gear", between = ["d", "a"], ratio = 1, efficiency = 0.5 }
push1 = { type = "torque", at = "b", torque = { triangle = 1, frequency = 2 } }
push2 = { type = "torque", at = "c", torque = { triangle = 2, frequency = 0.7 } }
shaft = { type = "spring", between = ["c", "ground"], stiffness = 3 }
push3 = { type = "torque", at = "d", torque = { sine = 3, frequency = 2, offset = -1 } }
)"},
};

}  // namespace

TEST_CASE("a worm gear lets go as soon as its load exceeds what it holds, at every turn of the load") {
  // Pushed further against the spring, the gear slips from m / 0.4098 on, where m is the torque of the spring by 0.9.
  const RunTable rows = simulate("domain = \"rotation\"\n[elements]" + std::string(winds_up) + "[simulate]\nstop = 2\noutput = { points = 801 }\n");
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    CAPTURE(rows.time()[k]);
    const double held = std::abs(rows["shaft.force"][k]) / 0.9 / 0.4098;
    if (rows["a.velocity"][k] == 0) CHECK_LE(rows["push.force"][k], held + 1e-6);
  }
}

TEST_CASE("a gear of which the load can take all takes none of it where a worm gear holds all") {
  const RunTable rows = simulate(scene_of("domain = \"rotation\"\n[elements]" + std::string(just_holds) + "[simulate]\nstop = 1\noutput = { points = 41 }\n"));
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    CHECK(rows["b.velocity"][k] == 0);
    CHECK_LE(std::abs(rows["gear.force"][k]), 1e-12);
  }
}

TEST_CASE("gears and a brake slip together beyond the sum of what they hold") {
  // Brake and bearing hold 1.8 N m of the torque at b, behind efficiencies of 0.5. The rest accelerates 7 kg m^2.
  for (const double torque : {-3.0, -1.98, -1.81, -1.78, -0.98, 0.92, 1.72, 1.79, 1.92, 2.62}) {
    CAPTURE(torque);
    Summary summary;
    const RunTable rows = simulate(scene_of("domain = \"rotation\"\n[elements]" + fmt::format(fmt::runtime(all_or_none), torque) + "[simulate]\nstop = 1\noutput = { points = 11 }\n"), &summary);
    const double slips = std::copysign(std::max(0.0, std::abs(torque) - 1.8) / 7, torque);
    for (const char* node : {"a", "b", "c", "d"}) CHECK(rows[std::string(node) + ".velocity"].back() == doctest::Approx(slips).epsilon(1e-12));
    CHECK_LE(std::abs(summary.missing), 1e-11 * summary.largest);
  }
}

TEST_CASE("a brake that a worm gear locks holds no more than its bound, also in the row before it slips") {
  const RunTable rows = simulate(scene_of("domain = \"rotation\"\n[elements]" + std::string(beyond) + "[simulate]\nstop = 2\noutput = { points = 41, events = true }\n"));
  CHECK(rows.time().size() > 50);  // events add rows to the 41 asked for
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    CAPTURE(rows.time()[k]);
    CHECK_LE(std::abs(rows["brake.force"][k]), 1 + 1e-9);
  }
}

TEST_CASE("a worm gear that jams at a node without inertia is named as such") {
  const std::string text = R"(
domain = "rotation"
[elements]
J = { type = "inertia", at = "a", inertia = 1 }
worm = { type = "gear", between = ["b", "a"], ratio = -2, efficiency = [0.777, -0.007] }
push1 = { type = "torque", at = "a", torque = 1.11 }
push2 = { type = "torque", at = "b", torque = 2.22 }
spring = { type = "spring", between = ["b", "ground"], stiffness = 3 }
[simulate]
stop = 2
)";
  std::string told;
  try {
    simulate(scene_of(text));
  } catch (const std::exception& error) {
    told = error.what();
  }
  CAPTURE(told);
  CHECK(told.find("a self-locking gear may jam") != told.npos);
}

TEST_CASE("gears that brakes and freewheels lock together with losses") {
  for (const Locked& one : scenes) {
    const std::string text = fmt::format("domain = \"rotation\"\n[elements]{}[simulate]\nstop = 4\noutput = {{ points = 41 }}\n{}\n", one.elements, one.simulate);
    CAPTURE(std::string(one.what));
    Summary summary;
    const RunTable exact = simulate(scene_of(text), &summary);
    CHECK_LE(std::abs(summary.missing), 1e-11 * summary.largest);
    Scene by_ida = scene_of(text, 1e-9);
    by_ida.method = Scene::Method::ida;
    const RunTable rows = simulate(by_ida);
    for (const std::string& column : exact.header) {
      CAPTURE(column);
      REQUIRE(rows[column].size() == exact[column].size());
      // An idle gear transmits round-off.
      const double tolerance = 1e-7 * exact.scale(column) + 1e-13;
      for (std::size_t k = 0; k < rows[column].size(); ++k) CHECK_LE(std::abs(rows[column][k] - exact[column][k]), tolerance);
    }
  }
}

}  // namespace rheonet::test::gears_locked_within_bounds_test
