// Starts from rest and in steady motion with gears whose supports move, and with gears that have losses.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::train_start_test {

namespace {

std::string start_from(const std::string& what, double stop) {
  return fmt::format("[simulate]\nstart_from = \"{}\"\nstop = {}\naccuracy = 1e-9\noutput = {{ points = 11 }}\n", what, stop);
}

/// By how much a column changes in the run, relative to its largest value or to `least`.
double change_of(const RunTable& rows, const std::string& column, double least) {
  double largest = 0;
  for (const double x : rows[column]) largest = std::max(largest, std::abs(x - rows[column][0]));
  return largest / std::max(rows.scale(column), least);
}

}  // namespace

TEST_CASE("starts with trains: springs at a planetary gear take the torque by its ratio") {
  const double r = 2.3, T = 3.1, kr = 41, kc = 73;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
g = {{ type = "planetary", between = ["s", "c", "r"], ratio = {} }}
T = {{ type = "torque", at = "s", torque = {} }}
Js = {{ type = "inertia", at = "s", inertia = 0.3 }}
Jc = {{ type = "inertia", at = "c", inertia = 0.7 }}
kr = {{ type = "spring", between = ["r", "ground"], stiffness = {} }}
kc = {{ type = "spring", between = ["c", "ground"], stiffness = {} }}
)~", r, T, kr, kc) + start_from("rest", 1));
  const double c = (1 + r) * T / kc, ring = -r * T / kr;
  CHECK(error_of(rows, "c.position", [&](double) { return c; }) < 1e-13);
  CHECK(error_of(rows, "r.position", [&](double) { return ring; }) < 1e-13);
  CHECK(error_of(rows, "s.position", [&](double) { return (1 + r) * c - r * ring; }) < 1e-13);
  CHECK(error_of(rows, "g.force", [&](double) { return T; }) < 1e-13);
}

TEST_CASE("starts with trains: a load at a free planetary gear keeps its momentum, or is refused") {
  const std::string free = R"~(
domain = "rotation"
[elements]
g = { type = "planetary", between = ["s", "c", "r"], ratio = 2 }
Js = { type = "inertia", at = "s", inertia = 0.3 }
Jc = { type = "inertia", at = "c", inertia = 0.7 }
d = { type = "dashpot", between = ["r", "ground"], damping = 0.5 }
)~";
  // The ring rests, and w_s = 3 w_c: the motion that goes on has the inertia 9 Js + Jc at the carrier.
  const RunTable rows = simulate(free + "[nodes]\nc = { velocity = 1 }\ns = { velocity = 2 }\n" + start_from("steady", 1));
  const double w = (3 * 0.3 * 2 + 0.7 * 1) / (9 * 0.3 + 0.7);
  CHECK(error_of(rows, "c.velocity", [&](double) { return w; }) < 1e-12);
  CHECK(error_of(rows, "s.velocity", [&](double) { return 3 * w; }) < 1e-12);
  const std::string told = refusal(free + "T = { type = \"torque\", at = \"s\", torque = 1 }\n" + start_from("steady", 1));
  CAPTURE(told);
  CHECK(told.find("cannot take the force `T` for ever") != told.npos);
}

TEST_CASE("starts with trains: motions that do not fit a ratio are refused") {
  const std::string told = refusal(R"~(
domain = "rotation"
[elements]
g = { type = "planetary", between = ["s", "c", "r"], ratio = 2 }
s = { type = "motion", at = "drive", velocity = 3 }
ks = { type = "spring", between = ["drive", "s"], stiffness = 9 }
Js = { type = "inertia", at = "s", inertia = 0.3 }
Jc = { type = "inertia", at = "c", inertia = 0.7 }
kc = { type = "spring", between = ["c", "ground"], stiffness = 40 }
kr = { type = "spring", between = ["r", "ground"], stiffness = 40 }
)~" + start_from("steady", 1));
  CAPTURE(told);
  CHECK(told.find("transmission `g` at velocities that do not fit its ratio") != told.npos);
}

TEST_CASE("starts with trains: a motor drives a dashpot, and winds up a spring, through a gear with losses") {
  const double T = 3, i = 2.5, eta = 0.8, bearing = 0.1, c = 7, k = 11, torque = i * (eta * T - bearing);
  const auto text = [&](const std::string& load, const std::string& what) {
    return fmt::format(R"~(
domain = "rotation"
[elements]
T = {{ type = "torque", at = "a", torque = {} }}
Ja = {{ type = "inertia", at = "a", inertia = 0.3 }}
g = {{ type = "gear", between = ["a", "b"], ratio = {}, efficiency = [{}, 0.7], bearing = [{}, 0.2] }}
Jb = {{ type = "inertia", at = "b", inertia = 0.7 }}
)~", T, i, eta, bearing) + load + start_from(what, 1);
  };
  const RunTable turns = simulate(text(fmt::format("c = {{ type = \"dashpot\", between = [\"b\", \"ground\"], damping = {} }}\n", c), "steady"));
  CHECK(error_of(turns, "b.velocity", [&](double) { return torque / c; }) < 1e-13);
  CHECK(error_of(turns, "a.velocity", [&](double) { return i * torque / c; }) < 1e-13);
  const RunTable holds = simulate(text(fmt::format("k = {{ type = \"spring\", between = [\"b\", \"ground\"], stiffness = {} }}\n", k), "rest"));
  CHECK(error_of(holds, "b.position", [&](double) { return torque / k; }) < 1e-12);
  CHECK(error_of(holds, "k.force", [&](double) { return torque; }) < 1e-12);
  // Self-locking: the weight at b is held, on both sides of the limit.
  const auto held = [&](double efficiency) {
    return refusal(fmt::format(R"~(
domain = "rotation"
[elements]
Ja = {{ type = "inertia", at = "a", inertia = 0.3 }}
g = {{ type = "gear", between = ["a", "b"], ratio = 5, efficiency = [0.5, {}] }}
Jb = {{ type = "inertia", at = "b", inertia = 0.7 }}
W = {{ type = "torque", at = "b", torque = 4 }}
)~", efficiency) + start_from("rest", 1));
  };
  CHECK(held(-0.1) == "");
  CHECK(held(0) == "");
  CHECK(held(0.1) != "");
}

TEST_CASE("starts with trains: gears with losses and a brake hold what they can, from either side") {
  // Gears with losses and bearings in a row, then perhaps a soft shaft, then a brake.
  const auto row = [](double load, const char* at, const char* brake, bool shaft, const std::string& what) {
    return refusal(fmt::format(R"~(
domain = "rotation"
[elements]
T = {{ type = "torque", at = "{}", torque = {:.17g} }}
J0 = {{ type = "inertia", at = "x", inertia = 0.3 }}
g0 = {{ type = "gear", between = ["x", "y"], ratio = 3, efficiency = [0.6, 0.9], bearing = 0.1 }}
J1 = {{ type = "inertia", at = "y", inertia = 0.2 }}
g1 = {{ type = "gear", between = ["y", "z"], ratio = -2, efficiency = [0.5, 0.8], bearing = 0.2 }}
J2 = {{ type = "inertia", at = "z", inertia = 0.7 }}
k = {{ type = "{}", between = ["z", "w"], {} }}
J3 = {{ type = "inertia", at = "w", inertia = 0.4 }}
b = {{ type = "slider", between = ["{}", "ground"], coulomb = 0.2, breakaway = 0.25, normal = 8 }}
)~", at, load, shaft ? "spring" : "slider", shaft ? "stiffness = 30" : "coulomb = 100", brake) + start_from(what, 0.1));
  };
  const double from_x = ((2 / 2.0 + 0.2) / 0.5 / 3 + 0.1) / 0.6, from_w = 2 * ((3 * (2 / 0.9 + 0.1)) / 0.8 + 0.2);
  for (const bool shaft : {false, true}) {
    for (const char* what : {"rest", "steady"}) {
      for (const double share : {0.3, 0.6, 0.8, 0.999, -0.999}) {
        CAPTURE(share);
        CHECK(row(share * from_x, "x", "w", shaft, what) == "");
        CHECK(row(share * from_w, "w", "x", shaft, what) == "");
      }
      for (const double share : {1.001, -1.001, 3.0}) {
        CAPTURE(share);
        CHECK(row(share * from_x, "x", "w", shaft, what).find("cannot take the force `T` for ever") != std::string::npos);
        CHECK(row(share * from_w, "w", "x", shaft, what).find("cannot take the force `T` for ever") != std::string::npos);
      }
    }
  }
}

TEST_CASE("starts with trains: what starts at rest or in steady motion goes on like that") {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const std::array<std::string, 3> node{"x", "y", "z"};
  int moving = 0, resting = 0;
  for (int n = 0; n < 200; ++n) {
    const bool steady = n % 2 == 0;
    const int kind = n / 2 % 3;
    std::string text = "domain = \"rotation\"\n[elements]\n";
    if (kind == 0) text += fmt::format("g = {{ type = \"planetary\", between = [\"x\", \"y\", \"z\"], ratio = {} }}\n", between(0.3, 4));
    if (kind == 1) text += fmt::format("g = {{ type = \"gear\", between = [\"x\", \"y\"], support = \"z\", ratio = {} }}\n", between(-3, -0.3));
    if (kind == 2) text += fmt::format("g = {{ type = \"gear\", between = [\"x\", \"y\"], support = \"z\", ratio = {}, efficiency = [{}, {}], bearing = {} }}\n", between(0.3, 3), between(0.5, 1), between(0.5, 1), between(0, 0.5));
    for (int k = 0; k < 3; ++k) {
      const std::string& at = node[static_cast<std::size_t>(k)];
      const std::string& other = node[static_cast<std::size_t>((k + 1) % 3)];
      text += fmt::format("J{0} = {{ type = \"inertia\", at = \"{0}\", inertia = {1} }}\n", at, between(0.1, 2));
      text += fmt::format("T{0} = {{ type = \"torque\", at = \"{0}\", torque = {1} }}\n", at, between(-3, 3));
      const char* type = steady ? "dashpot" : "spring";
      const char* parameter = steady ? "damping" : "stiffness";
      text += fmt::format("h{0} = {{ type = \"{1}\", between = [\"{0}\", \"ground\"], {2} = {3} }}\n", at, type, parameter, between(1, 20));
      if (between(0, 1) < 0.5) text += fmt::format("f{0} = {{ type = \"slider\", between = [\"{0}\", \"{1}\"], coulomb = {2} }}\n", at, between(0, 1) < 0.5 ? "ground" : other, between(0.1, 1.5));
      if (between(0, 1) < 0.4) text += fmt::format("e{0} = {{ type = \"{1}\", between = [\"{0}\", \"{2}\"], {3} = {4} }}\n", at, type, other, parameter, between(1, 20));
    }
    text += start_from(steady ? "steady" : "rest", 0.7);
    CAPTURE(n);
    CAPTURE(text);
    const RunTable rows = simulate(text);
    for (const std::string& at : node) {
      // Where the balance is exactly at the bound of friction, round-off may let it creep.
      CHECK(change_of(rows, at + ".velocity", 1e-3) < 1e-8);
      if (steady) moving += rows[at + ".velocity"][0] != 0;
      if (!steady) {
        CHECK(change_of(rows, at + ".position", 1e-3) < 1e-8);
        resting += rows[at + ".position"][0] != 0;
      }
    }
    CHECK(change_of(rows, "g.force", 1e-3) < 1e-7);
  }
  CHECK(moving > 100);
  CHECK(resting > 100);
}

TEST_CASE("starts with trains: motions drive gears with losses from either side, and laws with kinks rest exactly") {
  // A motion at a turns a dashpot at b, and the other way round.
  const auto driven = [](const char* motion, const char* dashpot) {
    return simulate(fmt::format(R"~(
domain = "rotation"
[elements]
g = {{ type = "gear", between = ["a", "b"], ratio = 4, efficiency = [0.5, 0.6], bearing = 0.3 }}
Ja = {{ type = "inertia", at = "a", inertia = 1 }}
Jb = {{ type = "inertia", at = "b", inertia = 1 }}
m = {{ type = "motion", at = "{}", velocity = 8 }}
c = {{ type = "dashpot", between = ["{}", "ground"], damping = 5 }}
)~", motion, dashpot) + start_from("steady", 1));
  };
  const RunTable from_a = driven("a", "b"), from_b = driven("b", "a");
  CHECK(error_of(from_a, "b.velocity", [](double) { return 2; }) < 1e-12);
  // While a drives: i (eta f_a - bearing) = c w_b.
  CHECK(error_of(from_a, "g.force", [](double) { return (10.0 / 4 + 0.3) / 0.5; }) < 1e-12);
  CHECK(error_of(from_b, "a.velocity", [](double) { return 32; }) < 1e-12);
  CHECK(error_of(from_b, "g.force", [](double) { return -160; }) < 1e-12);
  for (const char* law : {"st = { type = \"stop\", between = [\"r\", \"ground\"], lower = -0.1, upper = 0.1, stiffness = 1000 }\n",
                          "st = { type = \"sfm\", between = [\"r\", \"ground\"], stiffness = 1000, coulomb = 30 }\n"}) {
    CAPTURE(law);
    Summary summary;
    const RunTable rows = simulate(scene_of(std::string("domain = \"rotation\"\n[elements]\n") + law + R"~(
p = { type = "planetary", between = ["s", "c", "r"], ratio = 3 }
js = { type = "inertia", at = "s", inertia = 1 }
jc = { type = "inertia", at = "c", inertia = 1 }
jr = { type = "inertia", at = "r", inertia = 1 }
t = { type = "torque", at = "s", torque = 3 }
cc = { type = "spring", between = ["c", "ground"], stiffness = 10 }
)~" + start_from("rest", 1)), &summary);
    CHECK(error_of(rows, "c.position", [](double) { return 1.2; }) < 1e-12);
    CHECK(error_of(rows, "st.force", [](double) { return -9; }) < 1e-12);
    CHECK(summary.steps < 100);
  }
}

}  // namespace rheonet::test::train_start_test
