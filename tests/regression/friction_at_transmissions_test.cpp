// Friction at nodes that have a mass only through a transmission or a rigid link, and friction that meets other events at the same time.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/support/simulate.hpp"

namespace rheonet::test::friction_at_transmissions_test {

namespace {

std::map<std::string, std::vector<double>> events_of(const std::string& toml) {
  std::map<std::string, std::vector<double>> times;
  run(scene_of(toml), {.event = [&](double t, const std::string& name, const char*, int) { times[name].push_back(t); }});
  return times;
}

double largest(const RunTable& rows, const std::string& record) {
  double most = 0;
  for (const double value : rows[record]) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

// The play never closes: with it and without it the clutch slips and sticks at the same times.
TEST_CASE("a clutch behind a gear and an open backlash") {
  const auto drive = [](double ratio, double clutch, const char* play) {
    return fmt::format(R"(domain = "rotation"
[elements]
motor = {{ type = "torque", at = "shaft", torque = {{ sine = 1.3, frequency = 0.4 }} }}
rotor = {{ type = "inertia", at = "shaft", inertia = 0.7 }}
gear = {{ type = "gear", between = ["shaft", "pinion"], ratio = {} }}
{}
wheel = {{ type = "inertia", at = "wheel", inertia = 0.4 }}
clutch = {{ type = "slider", between = ["wheel", "load"], coulomb = {} }}
load = {{ type = "inertia", at = "load", inertia = 0.9 }}
spring = {{ type = "spring", between = ["load", "ground"], stiffness = 11 }}
push = {{ type = "torque", at = "wheel", torque = {{ sine = 2.1, frequency = 1.1 }} }}
[simulate]
stop = 3
)", ratio, play, clutch);
  };
  for (const double ratio : {-2.3, 0.6, 3.1}) {
    for (const double clutch : {0.3, 0.8}) {
      CAPTURE(ratio);
      CAPTURE(clutch);
      const RunTable without = simulate(drive(ratio, clutch, ""), 1e-9);
      for (const char* stiffness : {"\"inf\"", "1e4"}) {
        CAPTURE(stiffness);
        const RunTable with = simulate(drive(ratio, clutch, fmt::format("play = {{ type = \"stop\", between = [\"pinion\", \"wheel\"], lower = -50, upper = 50, stiffness = {} }}", stiffness).c_str()), 1e-9);
        for (const char* record : {"load.position", "wheel.velocity", "clutch.force"}) {
          double worst = 0;
          for (std::size_t row = 0; row < with.time().size(); ++row) worst = std::max(worst, std::abs(with[record][row] - without[record][row]));
          CHECK_LE(worst, 1e-8 * largest(without, record));
        }
      }
    }
  }
}

// Output and input shaft come to rest together, as the second clutch sticks. Then the second clutch and the brake slip, and the first
// clutch goes on slipping. An independent integration, mode by mode, gives the time at which it sticks.
TEST_CASE("a gearbox with two clutches and a brake, that come to rest at the same time") {
  const std::string toml = R"(domain = "rotation"
[elements]
J1 = { type = "inertia", at = "m", inertia = 0.97 }
T  = { type = "torque", at = "m", torque = { sine = 8.04, frequency = 1.11 } }
J2 = { type = "inertia", at = "o", inertia = 1.81 }
To = { type = "torque", at = "o", torque = { sine = 7.37, frequency = 1.98, phase = 1 } }
c0 = { type = "slider", between = ["m", "lo"], coulomb = 3.1 }
g1 = { type = "gear", between = ["lo", "o"], ratio = 2.14 }
c1 = { type = "slider", between = ["m", "hi"], coulomb = 2.15 }
g2 = { type = "gear", between = ["hi", "o"], ratio = 1.37 }
c2 = { type = "slider", between = ["o", "ground"], coulomb = 1.44 }
[simulate]
stop = 4
output = { points = 1001 }
)";
  const std::vector<double> times = events_of(toml)["c0"];
  CHECK(std::any_of(times.begin(), times.end(), [](double t) { return std::abs(t - 1.61800) < 1e-5; }));
  CHECK(std::none_of(times.begin(), times.end(), [](double t) { return t > 1.5 && t < 1.617; }));
  const RunTable rows = simulate(toml, 1e-6);
  CHECK_LE(largest(rows, "c0.force"), 3.1 * (1 + 1e-9));
  CHECK_LE(largest(rows, "c1.force"), 2.15 * (1 + 1e-9));
  CHECK_LE(largest(rows, "c2.force"), 1.44 * (1 + 1e-9));
}

// A curve that is steeper one way, and the same law in the netlist.
TEST_CASE("friction beside a dashpot that resists one way more than the other") {
  const auto scene = [](const char* element, double coulomb) {
    return fmt::format(R"([laws.valve]
parameters = {{ low = "1 N*s/m", high = "3 N*s/m" }}
force = "w > 0 ? low*w : high*w"
[elements]
b  = {{ type = "motion", at = "b", velocity = {{ sine = 1.95, frequency = 0.33 }} }}
mc = {{ type = "mass", at = "c", mass = 1.31 }}
md = {{ type = "mass", at = "d", mass = 1.34 }}
e1 = {{ {}, between = ["c", "b"] }}
e2 = {{ type = "slider", coulomb = {}, between = ["d", "c"] }}
e5 = {{ type = "dashpot", damping = 0.71, between = ["d", "b"] }}
[simulate]
stop = 3
)", element, coulomb);
  };
  for (const double coulomb : {0.05, 0.5, 0.9}) {
    CAPTURE(coulomb);
    const RunTable curve = simulate(scene("type = \"dashpot\", force = [[-1, -3], [0, 0], [1, 1]]", coulomb), 1e-8);
    const RunTable law = simulate(scene("type = \"valve\"", coulomb), 1e-8);
    CHECK_LE(largest(curve, "e2.force"), coulomb * (1 + 1e-9));
    for (const char* record : {"c.velocity", "d.velocity", "e1.force"}) {
      double worst = 0;
      for (std::size_t row = 0; row < law.time().size(); ++row) worst = std::max(worst, std::abs(curve[record][row] - law[record][row]));
      CHECK_LE(worst, 1e-7 * largest(law, record));
    }
  }
}

}  // namespace rheonet::test::friction_at_transmissions_test
