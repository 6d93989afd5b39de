// Gears, levers, racks and screws without losses.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::gear_test {

namespace {

constexpr double pi = std::numbers::pi;

constexpr double rounding = 1e-13;

}  // namespace

TEST_CASE("gears: a train of three reflects its inertias by the squares of the ratios") {
  const double J1 = 0.31, J2 = 0.77, J3 = 12.3, i = 2.7, j = -3.1, T = 4.3;
  const RunTable rows = simulate(fmt::format(R"~(
[elements]
motor = {{ type = "torque", at = "a", torque = {} }}
J1 = {{ type = "inertia", at = "a", inertia = {} }}
g1 = {{ type = "gear", between = ["a", "b"], ratio = {} }}
J2 = {{ type = "inertia", at = "b", inertia = {} }}
g2 = {{ type = "gear", between = ["b", "c"], ratio = {} }}
J3 = {{ type = "inertia", at = "c", inertia = {} }}
)~", T, J1, i, J2, j, J3) + simulate_until(1.3));
  const double J = J1 + J2 / (i * i) + J3 / (i * i * j * j), a = T / J;
  CHECK(error_of(rows, "a.velocity", [&](double t) { return a * t; }) < rounding);
  CHECK(error_of(rows, "b.velocity", [&](double t) { return a * t / i; }) < rounding);
  CHECK(error_of(rows, "c.velocity", [&](double t) { return a * t / (i * j); }) < rounding);
  CHECK(error_of(rows, "c.position", [&](double t) { return a * t * t / 2 / (i * j); }) < 1e-8);
  // The force of a gear is the one at its first node: what drives all that is behind it.
  CHECK(error_of(rows, "g1.force", [&](double) { return (J - J1) * a; }) < rounding);
  CHECK(error_of(rows, "g2.force", [&](double) { return J3 * a / (i * j) / j; }) < rounding);
  CHECK(error_of(rows, "g1.velocity", [&](double t) { return a * t * (1 - 1 / i); }) < rounding);
  CHECK(error_of(rows, "J3.force", [&](double) { return J3 * a / (i * j); }) < rounding);
}

TEST_CASE("gears: between a spring and a dashpot the relaxation time has the square of the ratio") {
  const double k = 37.0, B = 5.3, i = -1.9, v = 0.7;
  const RunTable rows = simulate(fmt::format(R"~(
[elements]
drive = {{ type = "motion", at = "a", velocity = {} }}
k = {{ type = "spring", between = ["a", "b"], stiffness = {} }}
g = {{ type = "lever", between = ["b", "c"], ratio = {} }}
B = {{ type = "dashpot", between = ["c", "ground"], damping = {} }}
)~", v, k, i, B) + simulate_until(1.1));
  // Seen from a, the dashpot has B/i^2.
  const double seen = B / (i * i), tau = seen / k;
  const auto f = [&](double t) { return seen * v * (1 - std::exp(-t / tau)); };
  CHECK(error_of(rows, "k.force", f) < 1e-8);
  CHECK(error_of(rows, "B.force", [&](double t) { return i * f(t); }) < 1e-8);
  CHECK(error_of(rows, "g.force", f) < 1e-8);
  CHECK(error_of(rows, "B.velocity", [&](double t) { return i * f(t) / B; }) < 1e-8);
}

TEST_CASE("gears: a brake behind a gear holds and slips at its torque times or over the ratio") {
  const double i = 4.7, Tc = 3.0, J = 0.9, slope = 1.1;
  // The torque at the motor rises; the brake at the fast shaft holds up to Tc i at the slow one.
  const std::string text = fmt::format(R"~(
[elements]
motor = {{ type = "torque", at = "slow", torque = {{ ramp = {} }} }}
J = {{ type = "inertia", at = "slow", inertia = {} }}
g = {{ type = "gear", between = ["fast", "slow"], ratio = {} }}
brake = {{ type = "slider", between = ["fast", "ground"], coulomb = {} }}
)~", slope, J, i, Tc);
  const RunTable rows = simulate(text + simulate_until(20, 1e-9));
  const double t0 = Tc * i / slope;
  CHECK(error_of(rows, "slow.velocity", [&](double t) { return t < t0 ? 0 : slope * (t - t0) * (t - t0) / 2 / J; }) < 1e-7);
  CHECK(error_of(rows, "brake.force", [&](double t) { return std::min(slope * t / i, Tc); }) < 1e-7);
  CHECK(error_of(rows, "g.force", [&](double t) { return -std::min(slope * t / i, Tc); }) < 1e-7);
  CHECK(error_of(rows, "fast.velocity", [&](double t) { return i * (t < t0 ? 0 : slope * (t - t0) * (t - t0) / 2 / J); }) < 1e-7);
}

TEST_CASE("gears: a freewheel behind a reversing gear holds the direction that it holds") {
  const double J = 1.7, T = 0.9;
  const auto text = [&](double ratio, double torque) {
    return fmt::format(R"~(
[elements]
motor = {{ type = "torque", at = "a", torque = {} }}
J = {{ type = "inertia", at = "a", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
f = {{ type = "freewheel", between = ["b", "ground"] }}
)~", torque, J, ratio) + simulate_until(1);
  };
  for (const double ratio : {2.3, -2.3}) {
    for (const double torque : {T, -T}) {
      const RunTable rows = simulate(text(ratio, torque));
      // b turns forward freely: a does too for a positive ratio.
      const bool free = torque * ratio > 0;
      CAPTURE(ratio);
      CAPTURE(torque);
      CHECK(rows["a.velocity"].back() == doctest::Approx(free ? torque / J : 0).epsilon(1e-10));
      CHECK(rows["f.force"].back() == doctest::Approx(free ? 0 : torque * ratio).epsilon(1e-10));
      CHECK(rows["b.velocity"].back() == doctest::Approx(free ? torque / J / ratio : 0).epsilon(1e-10));
    }
  }
}

TEST_CASE("racks: a mass behind a pinion is an inertia m r^2") {
  const double m = 3.7, J = 0.21, r = 0.083, T = 1.9, g = 9.81;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
motor = {{ type = "torque", at = "drum", torque = {} }}
J = {{ type = "inertia", at = "drum", inertia = {} }}
rope = {{ type = "rack", between = ["drum", "load"], radius = {} }}
m = {{ type = "mass", at = "load", mass = "{} kg" }}
weight = {{ type = "force", at = "load", force = "{} N" }}
)~", T, J, r, m, -m * g) + simulate_until(1.7));
  const double a = (T - m * g * r) / (J + m * r * r);
  CHECK(error_of(rows, "drum.velocity", [&](double t) { return a * t; }) < rounding);
  CHECK(error_of(rows, "load.velocity", [&](double t) { return r * a * t; }) < rounding);
  CHECK(error_of(rows, "rope.force", [&](double) { return T - J * a; }) < rounding);
}

TEST_CASE("screws: force and torque in statics, and a left-handed thread") {
  for (const double lead : {0.005, -0.0031}) {
    const double k = 8.1e4, T = 0.37;
    const RunTable rows = simulate(fmt::format(R"~(
[elements]
hand = {{ type = "torque", at = "spindle", torque = {} }}
thread = {{ type = "screw", between = ["spindle", "nut"], lead = {} }}
press = {{ type = "spring", between = ["nut", "ground"], stiffness = {} }}
rub = {{ type = "dashpot", between = ["nut", "ground"], damping = "10 N*s/m" }}
[nodes]
nut = {{ position = 0 }}
[simulate]
start_from = "rest"
stop = 1
accuracy = 1e-9
output = {{ points = 3 }}
)~", T, lead, k));
    const double F = T * 2 * pi / lead;
    CAPTURE(lead);
    CHECK(rows["press.force"].back() == doctest::Approx(F).epsilon(1e-10));
    CHECK(rows["nut.position"].back() == doctest::Approx(F / k).epsilon(1e-10));
    CHECK(rows["thread.force"].back() == doctest::Approx(T).epsilon(1e-10));
  }
}

TEST_CASE("gears: transmissions in a loop share the load if their ratios agree, and are refused if not") {
  const auto text = [](double second) {
    return fmt::format(R"~(
domain = "rotation"
[elements]
motor = {{ type = "torque", at = "a", torque = 6 }}
g1 = {{ type = "gear", between = ["a", "b"], ratio = 2 }}
g2 = {{ type = "gear", between = ["b", "c"], ratio = 3 }}
g3 = {{ type = "gear", between = ["a", "c"], ratio = {} }}
J = {{ type = "inertia", at = "c", inertia = 3 }}
)~", second) + simulate_until(1);
  };
  const RunTable rows = simulate(text(6));
  CHECK(error_of(rows, "c.velocity", [](double t) { return 12 * t; }) < 1e-12);
  // g2 carries at b what g1 does: f2 = 2 f1.
  CHECK(rows["g2.force"].back() == doctest::Approx(2 * rows["g1.force"].back()));
  CHECK(rows["g1.force"].back() + rows["g3.force"].back() == doctest::Approx(6));
  const std::string message = refusal(text(5));
  CAPTURE(message);
  CHECK(message.find("`g2` makes a loop with `g1`, `g3`") != message.npos);
  CHECK(message.find("the velocity of `b` is 3 times that of `c` by `g2`, and 2.5 times by the others") != message.npos);
}

TEST_CASE("gears: energy, power and acceleration behind a gear") {
  const double J = 0.83, i = -3.3, k = 41.0, T = 2.2;
  RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
motor = {{ type = "torque", at = "a", torque = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
J = {{ type = "inertia", at = "b", inertia = {} }}
k = {{ type = "spring", between = ["b", "ground"], stiffness = {} }}
B = {{ type = "dashpot", between = ["b", "ground"], damping = 1.3 }}
[simulate]
stop = 2
accuracy = 1e-9
output = {{ points = 41 }}
record = ["k.energy", "J.energy", "B.dissipated", "motor.power", "a.acceleration", "b.acceleration", "k.displacement", "b.velocity", "a.velocity", "g.power",
          {{ name = "twist", value = "a.position - b.position" }}, "g.displacement", "k.force", "B.velocity"]
)~", T, i, J, k));
  for (std::size_t n = 0; n < rows.time().size(); ++n) {
    const double x = rows["k.displacement"][n], v = rows["b.velocity"][n];
    CHECK(rows["k.energy"][n] == doctest::Approx(k * x * x / 2).epsilon(1e-10));
    CHECK(rows["J.energy"][n] == doctest::Approx(J * v * v / 2).epsilon(1e-10));
    CHECK(rows["B.dissipated"][n] == doctest::Approx(1.3 * v * v).epsilon(1e-9));
    CHECK(rows["motor.power"][n] == doctest::Approx(T * i * v).epsilon(1e-10));
    CHECK(rows["a.velocity"][n] == doctest::Approx(i * v).epsilon(1e-10));
    CHECK(rows["a.acceleration"][n] == doctest::Approx(i * rows["b.acceleration"][n]).epsilon(1e-10));
    CHECK(J * rows["b.acceleration"][n] == doctest::Approx(i * T - k * x - 1.3 * v).epsilon(1e-7));
    CHECK(rows["g.power"][n] == 0);
    CHECK(rows["twist"][n] == rows["g.displacement"][n]);
    CHECK(rows["g.displacement"][n] == doctest::Approx((i - 1) * x).epsilon(1e-10));
  }
  Summary summary;
  simulate(scene_of(fmt::format(R"~(
domain = "rotation"
[elements]
motor = {{ type = "torque", at = "a", torque = {{ sine = {}, frequency = 1.1 }} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
J = {{ type = "inertia", at = "b", inertia = {} }}
c = {{ type = "cfm", between = ["b", "ground"], stiffness = {}, coulomb = 3, damping = 2 }}
)~", T, i, J, k) + simulate_until(3, 1e-8)), &summary);
  CHECK(std::abs(summary.missing) < 1e-6 * summary.largest);
  CHECK(summary.supplied > 0);
}

TEST_CASE("gears: blocks sense and drive in the units of their nodes") {
  // A servo: its torque at the motor follows the position of the load behind the gear.
  const double i = 5.3, J = 0.41, kp = 19.0, kd = 7.0, target = 0.8;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
motor = {{ type = "torque", at = "a", torque = {{ block = "control" }} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
J = {{ type = "inertia", at = "b", inertia = {} }}
wish = {{ type = "generator", signal = "{} rad" }}
p = {{ type = "gain", in = "b.position", gain = "{} N*m/rad" }}
w = {{ type = "gain", in = "wish", gain = "{} N*m/rad" }}
d = {{ type = "gain", in = "b.velocity", gain = "{} N*m*s/rad" }}
control = {{ type = "sum", in = ["w", "-p", "-d"] }}
)~", i, J, target, kp, kp, kd) + simulate_until(2));
  // J x'' = i (kp (target - x) - kd x')
  const double a = i * kd / J / 2, root = std::sqrt(a * a - i * kp / J), fast = a + root, slow = a - root;
  const auto x = [&](double t) { return target * (1 - (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow)); };
  CHECK(error_of(rows, "b.position", x) < 1e-7);
  CHECK(error_of(rows, "a.position", [&](double t) { return i * x(t); }) < 1e-7);
  CHECK(rows["motor.force"].front() == doctest::Approx(kp * target));
  CHECK(rows["control.out"].front() == doctest::Approx(kp * target));
}

TEST_CASE("gears: start values, rest and steady motion") {
  const std::string text = R"~(
domain = "rotation"
[elements]
drive = { type = "motion", at = "a", velocity = 6 }
k = { type = "spring", between = ["a", "b"], stiffness = 10 }
g = { type = "gear", between = ["b", "c"], ratio = -3 }
B = { type = "dashpot", between = ["c", "ground"], damping = 4 }
J = { type = "inertia", at = "c", inertia = 2 }
[simulate]
start_from = "steady"
stop = 1
accuracy = 1e-9
output = { points = 5 }
)~";
  const RunTable rows = simulate(text);
  CHECK(rows["c.velocity"].front() == doctest::Approx(-2));
  CHECK(rows["c.velocity"].back() == doctest::Approx(-2));
  CHECK(rows["B.force"].front() == doctest::Approx(-8));
  CHECK(rows["k.force"].front() == doctest::Approx(8.0 / 3));
  const RunTable given = simulate(R"~(
domain = "rotation"
[elements]
g = { type = "gear", between = ["b", "c"], ratio = -3 }
J1 = { type = "inertia", at = "b", inertia = 1 }
J = { type = "inertia", at = "c", inertia = 2 }
s = { type = "spring", between = ["c", "ground"], stiffness = 5, f0 = -2 }
[nodes]
b = { position = 7, velocity = 6 }
c = { position = "-3 rad", velocity = "-2 rad/s" }
[simulate]
stop = 1
accuracy = 1e-9
output = { points = 5 }
)~");
  CHECK(given["b.position"].front() == 7);
  CHECK(given["c.position"].front() == -3);
  CHECK(given["c.velocity"].front() == doctest::Approx(-2));
  CHECK(given["b.velocity"].front() == doctest::Approx(6));
  CHECK(given["s.force"].front() == doctest::Approx(-2));
  // (1 i^2 + 2) a = 2
  CHECK(given["s.force"].back() == doctest::Approx(-2 + 5 * (given["c.position"].back() + 3)));
}

TEST_CASE("gears: masses that gears join go on with their common momentum, and friction beside them takes no impulse") {
  for (const double i : {1.0, -2.5}) {
    const double J1 = 0.7, J2 = 1.9, J3 = 0.4, w1 = 3, w2 = 1.3, Tc = 0.2;
    const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
J1 = {{ type = "inertia", at = "a", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
J2 = {{ type = "inertia", at = "b", inertia = {} }}
s = {{ type = "slider", between = ["b", "c"], coulomb = {} }}
J3 = {{ type = "inertia", at = "c", inertia = {} }}
[nodes]
a = {{ velocity = {} }}
b = {{ velocity = {} }}
)~", J1, i, J2, Tc, J3, w1, w2) + simulate_until(0.1));
    // Momentum and inertia, seen from b.
    const double J = i * i * J1 + J2, v = (i * J1 * w1 + J2 * w2) / J, s = v > 0 ? 1 : -1;
    CAPTURE(i);
    CHECK(error_of(rows, "b.velocity", [&](double t) { return v - s * Tc / J * t; }) < 1e-12);
    CHECK(error_of(rows, "a.velocity", [&](double t) { return i * (v - s * Tc / J * t); }) < 1e-12);
    CHECK(error_of(rows, "c.velocity", [&](double t) { return s * Tc / J3 * t; }) < 1e-12);
  }
}

TEST_CASE("gears: a freewheel behind a massless shaft catches, and runs ahead, at a jump of the drive") {
  const double i = 2.5;
  const auto text = [&](const char* velocity) {
    return fmt::format(R"~(
domain = "rotation"
[elements]
drive = {{ type = "motion", at = "a", velocity = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
f = {{ type = "freewheel", between = ["c", "b"] }}
J = {{ type = "inertia", at = "c", inertia = 2 }}
[nodes]
c = {{ velocity = 1 }}
)~", velocity, i) + simulate_until(1);
  };
  // Faster from 0.5 s on: c is taken along at once. Slower: it runs ahead.
  const RunTable faster = simulate(text("{ step = 4, time = 0.5, offset = 2.5 }"));
  CHECK(faster["c.velocity"].front() == 1);
  CHECK(faster["c.velocity"].back() == doctest::Approx(6.5 / i));
  const RunTable slower = simulate(text("{ step = -2, time = 0.5, offset = 2.5 }"));
  CHECK(slower["c.velocity"].back() == doctest::Approx(1));
  CHECK(slower["b.velocity"].back() == doctest::Approx(0.5 / i));
  // It starts backwards: a plastic impact.
  const RunTable backwards = simulate(text("5"));
  CHECK(backwards["c.velocity"].front() == doctest::Approx(5 / i));
}

}  // namespace rheonet::test::gear_test
