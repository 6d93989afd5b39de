// Losses of gears: efficiency of the mesh, friction of the bearings, self-locking.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/network/component.hpp"
#include "core/result/certify.hpp"
#include "tests/analytic/geared_drive.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::loss_test {

TEST_CASE("losses: the side that drives loses its share of power") {
  const double J1 = 0.7, J2 = 1.9, i = 3, forwards = 0.8, backwards = 0.6;
  const std::string gear = fmt::format("ratio = {}, efficiency = [{}, {}]", i, forwards, backwards);
  // a drives: f_b = -i eta f_a.
  const RunTable motor = simulate(drive(J1, J2, "5", "-2", gear, 1));
  const double m = (5 + J1 * i * 2 / J2) / (J1 * i * i / J2 + 1 / forwards), up = (i * m - 2) / J2;
  CHECK(error_of(motor, "b.velocity", [&](double t) { return up * t; }) < 1e-11);
  CHECK(error_of(motor, "g.force", [&](double) { return m / forwards; }) < 1e-11);
  CHECK(error_of(motor, "g.dissipated", [&](double t) { return (1 - forwards) * m / forwards * i * up * t; }) < 1e-11);
  // While b drives backwards, f_a is eta times the torque at b over i.
  const RunTable brake = simulate(drive(J1, J2, "0.2", "-9", gear, 1));
  const double n = (0.2 + J1 * i * 9 / J2) / (J1 * i * i / J2 + backwards), down = (i * n - 9) / J2;
  CHECK(error_of(brake, "b.velocity", [&](double t) { return down * t; }) < 1e-11);
  CHECK(error_of(brake, "g.force", [&](double) { return backwards * n; }) < 1e-11);
}

TEST_CASE("losses: a self-locking gear holds its load, one that is just not lets it go") {
  const auto moved = [](const std::string& gear, double load) {
    const RunTable rows = simulate(drive(0.1, 2, "0", fmt::format("{}", -load), gear, 1));
    return std::abs(rows["b.velocity"].back());
  };
  CHECK(moved("ratio = 5, efficiency = [0.4, -0.01]", 7) == 0);
  CHECK(moved("ratio = 5, efficiency = [0.4, 0]", 7) == 0);
  CHECK(moved("ratio = 5, efficiency = [0.4, 0.01]", 7) > 0);
  // With friction of its bearings it holds until the torque at b reaches i times that.
  CHECK(moved("ratio = 5, efficiency = [0.4, 0.3], bearing = [0, 2]", 9.999) == 0);
  CHECK(moved("ratio = 5, efficiency = [0.4, 0.3], bearing = [0, 2]", 10.001) > 0);
  // And driven from a it moves the load, up and down.
  const RunTable up = simulate(drive(0.1, 2, "4", "-7", "ratio = 5, efficiency = [0.4, -0.5]", 1));
  const double m = (4 + 0.1 * 5 * 7 / 2) / (0.1 * 25 / 2 + 1 / 0.4);
  CHECK(error_of(up, "b.velocity", [&](double t) { return (5 * m - 7) / 2 * t; }) < 1e-11);
  const RunTable down = simulate(drive(0.1, 2, "-1", "-7", "ratio = 5, efficiency = [0.4, -0.5]", 1));
  const double n = (-1 + 0.1 * 5 * 7 / 2) / (0.1 * 25 / 2 - 0.5);
  CHECK(error_of(down, "b.velocity", [&](double t) { return (5 * n - 7) / 2 * t; }) < 1e-11);
}

TEST_CASE("losses: friction of the bearings alone is a slider between the gear and its support") {
  std::mt19937 random(3);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int n = 0; n < 30; ++n) {
    const double i = between(-3, 3), bearing = between(0.1, 1.5), c = between(0.1, 1), k = between(1, 30);
    const std::string around = fmt::format(R"~(
domain = "rotation"
[elements]
T1 = {{ type = "torque", at = "a", torque = {{ sine = {}, frequency = {} }} }}
J1 = {{ type = "inertia", at = "a", inertia = {} }}
J2 = {{ type = "inertia", at = "b", inertia = {} }}
T2 = {{ type = "torque", at = "b", torque = {{ sine = {}, frequency = {}, offset = {} }} }}
c = {{ type = "dashpot", between = ["b", "x"], damping = {} }}
k = {{ type = "spring", between = ["x", "ground"], stiffness = {} }}
f = {{ type = "slider", between = ["b", "ground"], coulomb = {} }}
)~", between(1, 5), between(0.2, 1), between(0.2, 2), between(0.2, 2), between(1, 5), between(0.2, 1), between(-1, 1), c, k, between(0, 1));
    const std::string run = "[simulate]\nstop = 3\naccuracy = 1e-9\noutput = { points = 31 }\nrecord = [\"a.velocity\", \"b.velocity\", \"b.position\", \"k.force\"]\n";
    const std::string gear = fmt::format("g = {{ type = \"gear\", between = [\"a\", \"b\"], ratio = {:.17g}", i);
    const RunTable lossy = simulate(around + gear + fmt::format(", bearing = {:.17g} }}\n", bearing) + run);
    const RunTable wired = simulate(around + gear + fmt::format(" }}\ns = {{ type = \"slider\", between = [\"a\", \"ground\"], coulomb = {:.17g} }}\n", bearing) + run);
    CAPTURE(n);
    CHECK(largest_error(lossy, wired) < 1e-7);
  }
}

TEST_CASE("losses: a gear goes through all its modes as an independent integration does") {
  // The torques of Modelica's example of a lossy gear: the motor's a sine, the load's a ramp; both efficiencies are 1/2.
  const double J1 = 1, J2 = 1.5, i = 2, stop = 0.5;
  const Loss loss{0.5, 0.5, 0, 0};
  const auto T1 = [](double t) { return 10 * std::sin(2 * std::numbers::pi * t); };
  const auto T2 = [](double t) { return -10 + 2.5 * t; };
  // Acceleration of b, by its direction; 0: it rests, if the torque at a is between both lines.
  const auto moving = [&](double t, int side) {
    for (const bool b_drives : {false, true}) {
      const auto [factor, offset] = loss.line(side, b_drives);
      const double m = (T1(t) - offset - J1 * i * T2(t) / J2) / (J1 * i * i / J2 + factor);
      if (loss.b_drives(side, m) == b_drives) return (T2(t) + i * m) / J2;
    }
    return std::nan("");
  };
  const auto rests = [&](double t) {
    const double m = -T2(t) / i;
    return T1(t) <= m + loss.lost(1, m) && T1(t) >= m - loss.lost(-1, m);
  };
  constexpr int steps = 500'000, rows = 50;
  const double h = stop / steps;
  std::vector<double> speed{0};
  double w = 0;
  int side = 0;
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    if (side == 0 && !rests(t)) side = T1(t) > -T2(t) / i ? 1 : -1;
    if (side != 0) {
      const double next = w + h / 6 * (moving(t, side) + 4 * moving(t + h / 2, side) + moving(t + h, side));
      if (next * side < 0 && w * side > 0) {
        w = 0;
        side = 0;
      } else {
        w = next;
      }
    }
    if ((k + 1) % (steps / rows) == 0) speed.push_back(w);
  }
  const RunTable run = simulate(drive(J1, J2, "{ sine = 10, frequency = 1 }", "{ ramp = 2.5, offset = -10 }", "ratio = 2, efficiency = 0.5", stop));
  REQUIRE(run.time().size() == speed.size());
  double largest = 0;
  for (std::size_t k = 0; k < speed.size(); ++k) largest = std::max(largest, std::abs(run["b.velocity"][k] - speed[k]));
  CHECK(largest < 2e-5);
  CHECK(*std::min_element(speed.begin(), speed.end()) < -0.01);
  CHECK(*std::max_element(speed.begin(), speed.end()) > 0.01);
}

TEST_CASE("losses: a support that a motion holds still is ground, and the energy account closes") {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int n = 0; n < 20; ++n) {
    const std::string around = fmt::format(R"~(
domain = "rotation"
[elements]
T1 = {{ type = "torque", at = "a", torque = {{ sine = {}, frequency = {}, offset = {} }} }}
J1 = {{ type = "inertia", at = "a", inertia = {} }}
J2 = {{ type = "inertia", at = "b", inertia = {} }}
k = {{ type = "spring", between = ["b", "ground"], stiffness = {} }}
)~", between(2, 6), between(0.2, 1), between(-1, 1), between(0.2, 2), between(0.2, 2), between(2, 30));
    const std::string run = "[simulate]\nstop = 3\naccuracy = 1e-9\noutput = { points = 31 }\nrecord = [\"a.velocity\", \"b.velocity\", \"b.position\", \"g.force\"]\n";
    const std::string gear = fmt::format("g = {{ type = \"gear\", between = [\"a\", \"b\"], ratio = {}, efficiency = [{}, {}], bearing = [{}, {}]", between(-3, 3), between(0.5, 1),
                                         between(0.3, 1), between(0, 0.5), between(0, 0.5));
    Summary summary;
    CAPTURE(n);
    const RunTable plain = simulate(scene_of(around + gear + " }\n" + run), &summary);
    const RunTable framed = simulate(around + gear + ", support = \"frame\" }\nm = { type = \"motion\", at = \"frame\", velocity = 0 }\n" + run);
    CHECK(largest_error(plain, framed) < 1e-6);
    CHECK(std::abs(summary.missing) <= 1e-7 * summary.largest);
    CHECK(summary.dissipated >= 0);
  }
}

TEST_CASE("losses: bad values are refused") {
  const auto message = [](const std::string& gear) { return refusal(drive(1, 1, "1", "0", gear, 1)); };
  CHECK(message("ratio = 2, efficiency = 1.2").find("`efficiency` must be at most 1") != std::string::npos);
  CHECK(message("ratio = 2, efficiency = 0").find("`efficiency` must be greater than 0") != std::string::npos);
  CHECK(message("ratio = 2, efficiency = [0.9, 0.8, 0.7]").find("`efficiency` takes one value or two, but has 3") != std::string::npos);
  CHECK(message("ratio = 2, bearing = \"1 kg\"").find("`bearing`") != std::string::npos);
  CHECK(message("ratio = 2, efficiency = [0.9, [[0, 0.3], [1, 1.5]]]").find("`efficiency` is 1.5 at a speed of 1: it must be at most 1") != std::string::npos);
  CHECK(message("ratio = 2, efficiency = [[0, 0.9], [1, 0]]").find("`efficiency` is 0 at a speed of 1: it must be greater than 0") != std::string::npos);
  CHECK(message("ratio = 2, efficiency = [[0, 0.9, 0.8], [1, 0.5, 0.4]]").find("[speed, number], but this has 3") != std::string::npos);
  CHECK(message("ratio = 2, bearing = [[0.5, 0.9], [1, 0.5]]").find("`bearing` begins at a speed of 0.5, and its value at rest is not known") != std::string::npos);
  CHECK(message("ratio = 2, efficiency = { sine = 0.1, frequency = 1 }").find("`efficiency` needs `table`") != std::string::npos);
  CHECK(message("ratio = 2, efficiency_b = 0.5").find("unknown key `efficiency_b`") != std::string::npos);
}

TEST_CASE("losses: with an efficiency of 0 nothing of what drives b is felt at a") {
  // While b drives, a turns under its own torque alone, and b is carried along.
  const double Ta = 0.2, Ja = 0.5, Jb = 0.25, Tb = 2.5, i = -0.5, w0 = -2;
  for (const double efficiency : {0.0, 1e-13, -1e-13}) {
    CAPTURE(efficiency);
    const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
Ta = {{ type = "torque", at = "a", torque = {} }}
Ja = {{ type = "inertia", at = "a", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {}, efficiency = [0.3, {}], bearing = [0, 0.5] }}
Jb = {{ type = "inertia", at = "b", inertia = {} }}
Tb = {{ type = "torque", at = "b", torque = {} }}
[nodes]
a = {{ velocity = {} }}
b = {{ velocity = {} }}
)~", Ta, Ja, i, efficiency, Jb, Tb, w0, w0 / i) + simulate_until(1));
    CHECK(error_of(rows, "a.velocity", [&](double t) { return w0 + Ta / Ja * t; }) < 1e-9);
    CHECK(error_of(rows, "b.velocity", [&](double t) { return (w0 + Ta / Ja * t) / i; }) < 1e-9);
  }
}

TEST_CASE("losses: two gears in series that stick share a load that both can bear") {
  // Between the gears the torque is within [3.2, 5] for the first, and within [16/3 eta2, 16/3/eta2] for the second.
  for (const std::string start : {"given", "rest"}) {
    CAPTURE(start);
    const RunTable rows = simulate(R"~(
domain = "rotation"
[elements]
Ja = { type = "inertia", at = "a", inertia = 1 }
Jb = { type = "inertia", at = "b", inertia = 1 }
Ta = { type = "torque", at = "a", torque = 2 }
Tb = { type = "torque", at = "b", torque = -16 }
g1 = { type = "gear", between = ["a", "m"], ratio = 2, efficiency = 0.8 }
g2 = { type = "gear", between = ["m", "b"], ratio = 3, efficiency = 0.9 }
[simulate]
start_from = ")~" + start + "\"\nstop = 1\noutput = { points = 5 }\n");
    for (std::size_t k = 0; k < rows.time().size(); ++k) {
      CHECK(rows["a.velocity"][k] == 0);
      CHECK(rows["g1.force"][k] == doctest::Approx(2).epsilon(1e-12));
      CHECK(rows["g2.force"][k] >= 4.8 * (1 - 1e-12));
      CHECK(rows["g2.force"][k] <= 5 * (1 + 1e-12));
    }
  }
}

namespace {

/// Gears between two shafts for 2 s; the first shaft has a small inertia, and a torque that rises from 0.
RunTable turned(const std::string& gears, const std::string& second_shaft, const std::string& record) {
  return simulate("domain = \"rotation\"\n[elements]\nTa = { type = \"torque\", at = \"a\", torque = { sine = 10, frequency = 1 } }\n"
                  "Ja = { type = \"inertia\", at = \"a\", inertia = 0.1 }\n" + gears + second_shaft +
                  "[simulate]\nstop = 2\naccuracy = 1e-9\noutput = { points = 21 }\nrecord = [" + record + "]\n");
}

}  // namespace

TEST_CASE("losses: the driving side changes while the force of the gear passes 0") {
  // Without friction of bearings all bounds are 0 at that moment. The same gear the other way round has its efficiencies exchanged.
  const auto run = [](const std::string& gear) {
    return turned(gear + "\n", "Jd = { type = \"inertia\", at = \"d\", inertia = 2 }\nk = { type = \"spring\", between = [\"d\", \"ground\"], stiffness = 30 }\n",
                  R"("a.velocity", "d.velocity", "g.dissipated", "d.position")");
  };
  const RunTable one = run("g = { type = \"gear\", between = [\"d\", \"a\"], ratio = 0.25, efficiency = [0.4, 0.7] }");
  const RunTable other = run("g = { type = \"gear\", between = [\"a\", \"d\"], ratio = 4, efficiency = [0.7, 0.4] }");
  CHECK(largest_error(one, other) < 1e-7);
}

TEST_CASE("losses: a self-locking gear stands, however light the motor") {
  for (const double Ja : {1.0, 0.01, 1e-6}) {
    CAPTURE(Ja);
    const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
Ja = {{ type = "inertia", at = "a", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = 2, efficiency = [0.5, -0.8] }}
Jb = {{ type = "inertia", at = "b", inertia = 4 }}
Tb = {{ type = "torque", at = "b", torque = {{ ramp = 3 }} }}
)~", Ja) + simulate_until(1));
    for (const double v : rows["b.velocity"]) CHECK(v == 0);
  }
}

TEST_CASE("losses: gears in series, and a torque that rises from 0, are one gear with the product of the efficiencies") {
  const auto run = [](const std::string& gears) {
    return turned(gears + "\n", "Jb = { type = \"inertia\", at = \"b\", inertia = 7.2 }\nTb = { type = \"torque\", at = \"b\", torque = { sine = 30, frequency = 1.7 } }\n",
                  R"("a.velocity", "b.velocity")");
  };
  const RunTable two = run("g1 = { type = \"gear\", between = [\"a\", \"m\"], ratio = 2, efficiency = [0.8, 0.5] }\ng2 = { type = \"gear\", between = [\"m\", \"b\"], ratio = -3, efficiency = [0.9, 0.7] }");
  const RunTable one = run("g = { type = \"gear\", between = [\"a\", \"b\"], ratio = -6, efficiency = [0.72, 0.35] }");
  CHECK(largest_error(two, one) < 1e-7);
}

TEST_CASE("losses: without dry friction a gear with losses is one without") {
  const auto text = [](const std::string& losses, const std::string& effects) {
    return effects + R"~(
[elements]
Ta = { type = "torque", at = "a", torque = { sine = 10, frequency = 1 } }
Ja = { type = "inertia", at = "a", inertia = 0.1 }
g = { type = "gear", between = ["a", "b"], ratio = 3)~" + losses + R"~( }
Jb = { type = "inertia", at = "b", inertia = 2 }
c = { type = "dashpot", between = ["b", "ground"], damping = 3 }
[simulate]
stop = 1
record = ["a.velocity", "b.velocity", "g.force"]
)~";
  };
  const std::string rotation = "domain = \"rotation\"\n";
  const RunTable plain = simulate(text("", rotation)), full = simulate(text(", efficiency = 0.7, bearing = 0.2", rotation));
  CHECK(largest_error(full, plain) > 0.01);
  for (const char* losses : {", efficiency = 0.7", ", bearing = 0.2", ", efficiency = [0.6, -0.1], bearing = [0.2, 0.1]", ", efficiency = [1, 0]"}) {
    CAPTURE(losses);
    CHECK(largest_error(simulate(text(losses, rotation + "[effects]\nwithout = [\"dry_friction\"]\n")), plain) == 0);
  }
}

TEST_CASE("losses: a light motor lifts, holds and lowers a load by a self-locking gear, and every row obeys the law") {
  const double J = 0.001, Jb = 46, weight = 1569.6, i = 32, ea = 0.45, eb = -0.3;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
motor = {{ type = "torque", at = "a", torque = {{ table = [[0, 125], [1.5, 125], [1.5, 0], [3, 0], [3, -22], [4.5, -22], [4.5, 0], [9, 0]] }} }}
Ja = {{ type = "inertia", at = "a", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {}, efficiency = [{}, {}] }}
Jb = {{ type = "inertia", at = "b", inertia = {} }}
W = {{ type = "torque", at = "b", torque = {} }}
[simulate]
stop = 5.5
accuracy = 1e-8
output = {{ points = 201 }}
record = ["a.velocity", "a.acceleration", "g.force"]
)~", J, i, ea, eb, Jb, -weight));
  std::array<int, 3> seen{};
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    const double w = rows["a.velocity"][k], f = rows["g.force"][k], m = (weight + Jb * rows["a.acceleration"][k] / i) / i;
    const double low = std::min(m / ea, eb * m), high = std::max(m / ea, eb * m), rounding = 1e-9 * weight / i;
    ++seen[w > 0 ? 2 : w < 0 ? 0 : 1];
    if (w > 0) CHECK(std::abs(f - high) < rounding);
    if (w < 0) CHECK(std::abs(f - low) < rounding);
    if (w == 0) CHECK((f > low - rounding && f < high + rounding));
  }
  for (const int count : seen) CHECK(count > 20);
}

// The lever may stand while its second node is pushed with at least eta_a T (a drives) or at most T/eta_b. The friction there takes a rising
// load from the one range to the other, but for some milliseconds, in which the lever goes off.
TEST_CASE("losses: a self-locking lever breaks away in the short time in which friction beside it cannot make it stand") {
  const double m = 0.02, M = 2, eta = 0.7, T = 0.098, from = -0.5, rate = 5, stop = 1;
  for (const double coulomb : {0.09, 0.1, 0.125}) {
    for (const char* method : {"auto", "ida"}) {
      for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(coulomb);
        CAPTURE(method);
        CAPTURE(accuracy);
        const RunTable rows = simulate(fmt::format(R"(
[elements]
ma = {{ type = "mass", at = "a", mass = {} }}
mb = {{ type = "mass", at = "b", mass = {} }}
g  = {{ type = "lever", between = ["a", "b"], ratio = 1, efficiency = [{}, -0.5] }}
fa = {{ type = "force", at = "a", force = {} }}
fb = {{ type = "force", at = "b", force = {{ ramp = {}, offset = {} }} }}
s  = {{ type = "slider", between = ["b", "ground"], coulomb = {} }}
[simulate]
stop = {}
method = "{}"
output = {{ points = 51 }}
record = ["a.velocity", "a.position", "s.force"]
)", m, M, eta, T, rate, from, coulomb, stop, method), accuracy);
        const double breaks = (coulomb - eta * T - from) / rate, mass = M + eta * m;
        for (std::size_t row = 0; row < rows.time().size(); ++row) {
          const double u = std::max(0.0, rows.time()[row] - breaks);
          CHECK_LE(std::abs(rows["a.velocity"][row] - rate * u * u / (2 * mass)), accuracy);
          CHECK_LE(std::abs(rows["a.position"][row] - rate * u * u * u / (6 * mass)), accuracy / 3);
          CHECK_LE(std::abs(rows["s.force"][row]), coulomb * (1 + 1e-12));
        }
      }
    }
  }
}

}  // namespace rheonet::test::loss_test
