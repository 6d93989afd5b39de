// Transmissions whose support moves, and transmissions in loops with other elements.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <random>
#include <string>

#include "core/result/certify.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::train_test {

namespace {

/// Accelerations and force of [ M c; c' 0 ] [ a; f ] = [ T; 0 ].
Eigen::Vector4d accelerations(const Eigen::Vector3d& inertia, const Eigen::Vector3d& row, const Eigen::Vector3d& load) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  for (int k = 0; k < 3; ++k) {
    matrix(k, k) = inertia[k];
    matrix(k, 3) = matrix(3, k) = row[k];
  }
  Eigen::Vector4d right;
  right << load, 0;
  return matrix.fullPivLu().solve(right);
}

}  // namespace

TEST_CASE("trains: a planetary gear shares torques by its ratio and the inertias at its three nodes") {
  const double r = 2.7;
  const std::array<Eigen::Vector3d, 4> cases{Eigen::Vector3d{0.31, 0.77, 1.9}, {0, 0.77, 1.9}, {0.31, 0, 1.9}, {0.31, 0.77, 0}};
  for (const Eigen::Vector3d& J : cases) {
    const Eigen::Vector3d T{4.3, -1.7, 0.9}, row{1, -(1 + r), r};  // sun, carrier, ring
    std::string text = "domain = \"rotation\"\n[elements]\np = { type = \"planetary\", between = [\"s\", \"c\", \"r\"], ratio = 2.7 }\n";
    const std::array<std::string, 3> node{"s", "c", "r"};
    for (int k = 0; k < 3; ++k) {
      const std::string& n = node[static_cast<std::size_t>(k)];
      text += fmt::format("T{0} = {{ type = \"torque\", at = \"{0}\", torque = {1} }}\n", n, T[k]);
      if (J[k] > 0) text += fmt::format("J{0} = {{ type = \"inertia\", at = \"{0}\", inertia = {1} }}\n", n, J[k]);
    }
    const Eigen::Vector4d a = accelerations(J, row, T);
    const RunTable rows = simulate(text + simulate_until(1.3));
    for (int k = 0; k < 3; ++k) {
      CHECK(error_of(rows, node[static_cast<std::size_t>(k)] + ".velocity", [&](double t) { return a[k] * t; }) < 1e-12);
      CHECK(error_of(rows, node[static_cast<std::size_t>(k)] + ".position", [&](double t) { return a[k] * t * t / 2; }) < 1e-8);
    }
    CHECK(error_of(rows, "p.force", [&](double) { return a[3]; }) < 1e-12);
  }
}

TEST_CASE("trains: with one node at ground, a planetary gear is a gear") {
  const double J1 = 0.31, J2 = 0.77, T = 4.3, r = 2.7;
  const auto text = [&](const std::string& nodes, const std::string& at) {
    return fmt::format(R"~(
domain = "rotation"
[elements]
p = {{ type = "planetary", between = [{}], ratio = {} }}
Ja = {{ type = "inertia", at = "s", inertia = {} }}
Jb = {{ type = "inertia", at = "{}", inertia = {} }}
T = {{ type = "torque", at = "s", torque = {} }}
)~", nodes, r, J1, at, J2, T) + simulate_until(1.3);
  };
  // Carrier at ground: w_s = -r w_r. Ring at ground: w_s = (1 + r) w_c.
  const RunTable carrier = simulate(text(R"("s", "ground", "r")", "r"));
  CHECK(error_of(carrier, "s.velocity", [&](double t) { return T / (J1 + J2 / (r * r)) * t; }) < 1e-12);
  CHECK(error_of(carrier, "r.velocity", [&](double t) { return -T / (J1 + J2 / (r * r)) * t / r; }) < 1e-12);
  const RunTable ring = simulate(text(R"("s", "c", "ground")", "c"));
  CHECK(error_of(ring, "c.velocity", [&](double t) { return T / (J1 + J2 / ((1 + r) * (1 + r))) * t / (1 + r); }) < 1e-12);
}

TEST_CASE("trains: a massless ring is held by a brake, and slips above its torque") {
  // The ring takes r times the torque of the sun. The brake slips at first, and locks when its torque has risen enough.
  const double r = 2.0, Js = 0.4, Jc = 0.9, T = 9.0, rise = 4.0, Tc0 = 1.0;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
T = {{ type = "torque", at = "s", torque = {} }}
Js = {{ type = "inertia", at = "s", inertia = {} }}
Jc = {{ type = "inertia", at = "c", inertia = {} }}
p = {{ type = "planetary", between = ["s", "c", "r"], ratio = {} }}
brake = {{ type = "slider", between = ["r", "ground"], coulomb = {{ ramp = {}, offset = {} }} }}
)~", T, Js, Jc, r, rise, Tc0) + "[simulate]\nstop = 1.5\naccuracy = 1e-10\noutput = { every = \"1 ms\" }\n");
  // While the ring turns backwards: f = -(Tc0 + rise t)/r at the sun, Js w_s' = T - |f|, Jc w_c' = (1 + r) |f|, w_r = ((1 + r) w_c - w_s)/r.
  const auto torque = [&](double t) { return (Tc0 * t + rise * t * t / 2) / r; };
  const auto sun = [&](double t) { return (T * t - torque(t)) / Js; };
  const auto carrier = [&](double t) { return (1 + r) * torque(t) / Jc; };
  // Both are quadratics in t: (1 + r) w_c = w_s.
  const double factor = (1 + r) * (1 + r) / Jc + 1 / Js;
  const double lock = (T / Js - factor * Tc0 / r) / (factor * rise / (2 * r));
  REQUIRE(lock > 0.1);
  REQUIRE(lock < 1.4);
  const double held = T / (Js + Jc / ((1 + r) * (1 + r)));
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    const double t = rows.time()[k];
    const double expected = t < lock ? sun(t) : sun(lock) + held * (t - lock);
    CHECK(rows["s.velocity"][k] == doctest::Approx(expected).epsilon(1e-8));
    if (t < lock) CHECK(rows["c.velocity"][k] == doctest::Approx(carrier(t)).epsilon(1e-8));
    if (t > lock) CHECK(rows["r.velocity"][k] == 0);
    if (t > lock + 1e-3) CHECK(rows["brake.force"][k] == doctest::Approx(-r * (T - Js * held)).epsilon(1e-8));
  }
}

TEST_CASE("trains: a clutch between two nodes of a planetary gear makes it turn as one") {
  const double Js = 0.4, Jc = 0.9, Jr = 0.7, T = 3.0;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
T = {{ type = "torque", at = "s", torque = {} }}
Js = {{ type = "inertia", at = "s", inertia = {} }}
Jc = {{ type = "inertia", at = "c", inertia = {} }}
Jr = {{ type = "inertia", at = "r", inertia = {} }}
p = {{ type = "planetary", between = ["s", "c", "r"], ratio = 2 }}
lock = {{ type = "slider", between = ["s", "c"], coulomb = 10 }}
)~", T, Js, Jc, Jr) + simulate_until(1));
  const double a = T / (Js + Jc + Jr);
  for (const char* node : {"s", "c", "r"}) CHECK(error_of(rows, std::string(node) + ".velocity", [&](double t) { return a * t; }) < 1e-12);
  // The ring is driven by the gear alone: 2 f_s = Jr a. The clutch carries what the sun leaves over.
  CHECK(error_of(rows, "p.force", [&](double) { return -Jr * a / 2; }) < 1e-12);
  CHECK(error_of(rows, "lock.force", [&](double) { return T - Js * a + Jr * a / 2; }) < 1e-12);
}

TEST_CASE("trains: a lever on a spring oscillates with the mass that is felt at its pivot") {
  // v_a - v_s = i (v_b - v_s) with masses at a and b, and a spring from the pivot to ground.
  const double ma = 0.8, mb = 2.3, ms = 0.5, k = 90, i = -1.7;
  const Eigen::Vector3d mass{ma, mb, ms}, row{1, -i, i - 1};
  // Two motions: the plane c'v = 0. Start in the one that a force at the pivot causes: v = M^-1-projected load direction.
  const Eigen::Vector4d by_pivot = accelerations(mass, row, {0, 0, 1});
  const double felt = 1 / by_pivot[2], omega = std::sqrt(k / felt), x0 = 0.03;
  // All nodes are displaced in proportion to the accelerations that a force at the pivot causes.
  const Eigen::Vector3d x = x0 / by_pivot[2] * by_pivot.head<3>();
  const RunTable rows = simulate(fmt::format(R"~(
[elements]
ma = {{ type = "mass", at = "a", mass = {} }}
mb = {{ type = "mass", at = "b", mass = {} }}
ms = {{ type = "mass", at = "s", mass = {} }}
l = {{ type = "lever", between = ["a", "b"], support = "s", ratio = {} }}
k = {{ type = "spring", between = ["s", "ground"], stiffness = {} }}
[nodes]
a = {{ position = {} }}
b = {{ position = {} }}
s = {{ position = {} }}
)~", ma, mb, ms, i, k, x[0], x[1], x[2]) + simulate_until(2, 1e-10));
  CHECK(error_of(rows, "s.position", [&](double t) { return x[2] * std::cos(omega * t); }) < 1e-8);
  CHECK(error_of(rows, "a.position", [&](double t) { return x[0] * std::cos(omega * t); }) < 1e-8);
  CHECK(error_of(rows, "b.velocity", [&](double t) { return -x[1] * omega * std::sin(omega * t); }) < 1e-8);
  CHECK(error_of(rows, "l.force", [&](double t) { return -k * x0 * by_pivot[3] * std::cos(omega * t); }) < 1e-8);
}

TEST_CASE("trains: a spring and a dashpot across a gear see the difference of its nodes") {
  const double J1 = 0.8, J2 = 2.3, i = 3.0, k = 90, c = 2;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
J1 = {{ type = "inertia", at = "a", inertia = {} }}
J2 = {{ type = "inertia", at = "b", inertia = {} }}
g = {{ type = "gear", between = ["a", "b"], ratio = {} }}
k = {{ type = "spring", between = ["a", "b"], stiffness = {} }}
c = {{ type = "dashpot", between = ["a", "b"], damping = {} }}
[nodes]
a = {{ velocity = {} }}
b = {{ velocity = 1 }}
)~", J1, J2, i, k, c, i) + simulate_until(2, 1e-10));
  // In the angle of b: (i^2 J1 + J2) x'' + (i - 1)^2 (c x' + k x) = 0.
  const double J = i * i * J1 + J2, s = (i - 1) * (i - 1), decay = s * c / J / 2, omega = std::sqrt(s * k / J - decay * decay);
  const auto x = [&](double t) { return std::exp(-decay * t) / omega * std::sin(omega * t); };
  CHECK(error_of(rows, "b.position", x) < 1e-8);
  CHECK(error_of(rows, "k.force", [&](double t) { return k * (i - 1) * x(t); }) < 1e-8);
}

TEST_CASE("trains: a gearbox shifts by its clutches") {
  // The nodes between clutches and gears have no mass. The second clutch slips until the motor has its new speed.
  const double J1 = 0.2, J2 = 3.0, i1 = 3.0, i2 = 1.5, T = 2.0, load = 0.5, Tc = 4.0;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
T = {{ type = "torque", at = "in", torque = {} }}
J1 = {{ type = "inertia", at = "in", inertia = {} }}
J2 = {{ type = "inertia", at = "out", inertia = {} }}
load = {{ type = "torque", at = "out", torque = {} }}
first = {{ type = "slider", between = ["in", "x"], coulomb = {{ pulse = 100, width = 1 }} }}
g1 = {{ type = "gear", between = ["x", "out"], ratio = {} }}
second = {{ type = "slider", between = ["in", "y"], coulomb = {{ step = {}, time = 1 }} }}
g2 = {{ type = "gear", between = ["y", "out"], ratio = {} }}
)~", T, J1, J2, -load, i1, Tc, i2) + simulate_until(4));
  const double first = (T * i1 - load) / (J1 * i1 * i1 + J2), slips = (Tc * i2 - load) / J2, second = (T * i2 - load) / (J1 * i2 * i2 + J2);
  const double lock = 1 + (i1 - i2) * first / (slips * i2 + (Tc - T) / J1);
  REQUIRE(lock < 3);
  const auto out = [&](double t) {
    return t < 1 ? first * t : t < lock ? first + slips * (t - 1) : first + slips * (lock - 1) + second * (t - lock);
  };
  const auto in = [&](double t) { return t < 1 ? i1 * out(t) : t < lock ? i1 * first + (T - Tc) / J1 * (t - 1) : i2 * out(t); };
  CHECK(error_of(rows, "out.velocity", out) < 1e-11);
  CHECK(error_of(rows, "in.velocity", in) < 1e-11);
  CHECK(error_of(rows, "x.velocity", [&](double t) { return i1 * out(t); }) < 1e-11);
  CHECK(error_of(rows, "y.velocity", [&](double t) { return i2 * out(t); }) < 1e-11);
}

namespace {

bool among(int n, std::initializer_list<int> some) { return std::find(some.begin(), some.end(), n) != some.end(); }

/// Elements of all kinds around three shafts, of which at most one has no inertia; `gear` joins them.
std::string around_three(std::mt19937& random, const std::string& gear) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const std::array<std::string, 3> node{"x", "y", "z"};
  const int light = std::uniform_int_distribution<int>(0, 5)(random);
  std::string text = "domain = \"rotation\"\n[elements]\n" + gear;
  for (int k = 0; k < 3; ++k) {
    const std::string& n = node[static_cast<std::size_t>(k)];
    if (k != light) text += fmt::format("J{0} = {{ type = \"inertia\", at = \"{0}\", inertia = {1} }}\n", n, between(0.1, 2));
    text += fmt::format("T{0} = {{ type = \"torque\", at = \"{0}\", torque = {{ sine = {1}, frequency = {2}, offset = {3} }} }}\n", n, between(0.2, 3),
                        between(0.2, 1), between(-1, 1));
    const std::string other = k == 2 || between(0, 1) < 0.5 ? "ground" : node[static_cast<std::size_t>(k) + 1];
    const double what = between(0, 4);
    if (what < 1.5) text += fmt::format("f{0} = {{ type = \"slider\", between = [\"{0}\", \"{1}\"], coulomb = {2} }}\n", n, other, between(0.1, 1.5));
    else if (what < 2.5) text += fmt::format("k{0} = {{ type = \"spring\", between = [\"{0}\", \"{1}\"], stiffness = {2} }}\n", n, other, between(1, 40));
    else if (what < 3.5) text += fmt::format("c{0} = {{ type = \"dashpot\", between = [\"{0}\", \"{1}\"], damping = {2} }}\n", n, other, between(0.1, 2));
  }
  return text + "[simulate]\nstop = 2\naccuracy = 1e-9\noutput = { points = 21 }\nrecord = [\"x.velocity\", \"y.velocity\", \"z.velocity\", \"x.position\", \"g.force\"]\n";
}

/// Largest difference of two runs in a column, relative to its largest value.
double difference(const RunTable& one, const RunTable& other, const std::string& column) {
  double largest = 0, scale = 1e-9;  // the floor: of shafts that stand
  for (std::size_t k = 0; k < one.time().size(); ++k) {
    largest = std::max(largest, std::abs(one[column][k] - other[column][k]));
    scale = std::max(scale, std::abs(one[column][k]));
  }
  return largest / scale;
}

/// The same for the force of the gear, while the shafts turn against each other: locked, it may share the load with sliders in several ways.
double difference_of_force(const RunTable& one, const RunTable& other, double times) {
  double largest = 0;
  for (std::size_t k = 0; k < one.time().size(); ++k) {
    const double x = one["x.velocity"][k], y = one["y.velocity"][k], z = one["z.velocity"][k];
    const bool turns = x != 0 && y != 0 && z != 0 && std::abs(x - y) > 1e-9 * std::abs(x);
    if (turns) largest = std::max(largest, std::abs(one["g.force"][k] - times * other["g.force"][k]));
  }
  return largest / one.scale("g.force");
}

}  // namespace

TEST_CASE("trains: a planetary gear is any gear between two of its nodes that turns against the third") {
  std::mt19937 random(7);
  for (int n = 0; n < 400; ++n) {
    const double r = std::uniform_real_distribution<double>(0.3, 4)(random);
    const auto seed = random();
    if (n >= 40 && !among(n, {133, 230, 251, 264, 368})) continue;  // those that once failed
    const auto run = [&](const std::string& gear) {
      std::mt19937 same(seed);
      const std::string text = around_three(same, gear);
      CAPTURE(text);
      return simulate(text);
    };
    const RunTable planetary = run(fmt::format("g = {{ type = \"planetary\", between = [\"x\", \"y\", \"z\"], ratio = {} }}\n", r));
    struct Same { const char *between, *support; double ratio, force; };
    // From (1 + r) w_y = w_x + r w_z. `force`: that at the first node is so many times the sun's.
    for (const Same& same : {Same{R"("x", "z")", "y", -r, 1}, Same{R"("z", "x")", "y", -1 / r, r}, Same{R"("y", "z")", "x", r / (1 + r), -(1 + r)},
                             Same{R"("x", "y")", "z", 1 + r, 1}}) {
      CAPTURE(n);
      CAPTURE(same.between);
      const RunTable gear = run(fmt::format("g = {{ type = \"gear\", between = [{}], support = \"{}\", ratio = {:.17g} }}\n", same.between, same.support, same.ratio));
      for (const char* column : {"x.velocity", "y.velocity", "z.velocity", "x.position"}) CHECK(difference(planetary, gear, column) < 1e-7);
      CHECK(difference_of_force(planetary, gear, 1 / same.force) < 1e-6);
    }
  }
}

TEST_CASE("trains: a support that a motion holds still is ground") {
  std::mt19937 random(11);
  for (int n = 0; n < 900; ++n) {
    const double i = std::uniform_real_distribution<double>(-3, 3)(random);
    const auto seed = random();
    if (n >= 40 && !among(n, {78, 299, 804})) continue;
    const auto run = [&](const std::string& support) {
      std::mt19937 same(seed);
      const std::string text = around_three(same, fmt::format("g = {{ type = \"gear\", between = [\"x\", \"y\"]{}, ratio = {} }}\nh = {{ type = \"dashpot\", between = [\"y\", \"z\"], damping = 1 }}\n",
                                                     support.empty() ? "" : ", support = \"frame\"", i) + support);
      CAPTURE(text);
      return simulate(text);
    };
    CAPTURE(n);
    const RunTable plain = run(""), framed = run("frame = { type = \"motion\", at = \"frame\", velocity = 0 }\n");
    for (const char* column : {"x.velocity", "y.velocity", "z.velocity", "x.position"}) CHECK(difference(plain, framed, column) < 1e-7);
    CHECK(difference_of_force(plain, framed, 1) < 1e-6);
  }
}

TEST_CASE("trains: a planetary gear that three sliders lock breaks loose where the power of the loads exceeds theirs") {
  // The train's force is open while all stick. Three motions could begin. The one with z at rest and w_x = (1 + r) w_y needs the least torque.
  const double r = 2.06, J = 1.22, rise = 2.7, Ty = 0.13, Fx = 1.27, Fy = 0.47, Fz = 1.2;
  const RunTable rows = simulate(fmt::format(R"~(
domain = "rotation"
[elements]
g = {{ type = "planetary", between = ["x", "y", "z"], ratio = {} }}
Tx = {{ type = "torque", at = "x", torque = {{ ramp = {} }} }}
fx = {{ type = "slider", between = ["x", "y"], coulomb = {} }}
Jy = {{ type = "inertia", at = "y", inertia = {} }}
Ty = {{ type = "torque", at = "y", torque = {} }}
fy = {{ type = "slider", between = ["y", "ground"], coulomb = {} }}
Jz = {{ type = "inertia", at = "z", inertia = 0.91 }}
fz = {{ type = "slider", between = ["z", "ground"], coulomb = {} }}
)~", r, rise, Fx, J, Ty, Fy, Fz) + simulate_until(0.6));
  const double breaks = (Fx * r + Fy - Ty) / (rise * (1 + r));
  REQUIRE(breaks > 0.2);
  REQUIRE(breaks < 0.5);
  CHECK(error_of(rows, "y.velocity", [&](double t) { return t < breaks ? 0 : rise * (1 + r) / (2 * J) * (t - breaks) * (t - breaks); }) < 1e-9);
  CHECK(error_of(rows, "x.velocity", [&](double t) { return (1 + r) * (t < breaks ? 0 : rise * (1 + r) / (2 * J) * (t - breaks) * (t - breaks)); }) < 1e-9);
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    const double t = rows.time()[k], f = rows["g.force"][k];
    CHECK(rows["z.velocity"][k] == 0);
    CHECK(rows["fz.force"][k] == doctest::Approx(-r * f).epsilon(1e-12));
    if (t > breaks) CHECK(f == doctest::Approx(rise * t - Fx).epsilon(1e-9));
    for (const auto& [name, bound] : {std::pair{"fx.force", Fx}, {"fy.force", Fy}, {"fz.force", Fz}}) CHECK(std::abs(rows[name][k]) <= bound * (1 + 1e-11));
  }
}

TEST_CASE("trains: masses that start with velocities that do not fit go on together") {
  const double Js = 0.4, Jc = 0.9, r = 2, w = 3;
  const Scene scene = scene_of(fmt::format(R"~(
domain = "rotation"
[elements]
Js = {{ type = "inertia", at = "s", inertia = {} }}
Jc = {{ type = "inertia", at = "c", inertia = {} }}
p = {{ type = "planetary", between = ["s", "c", "ground"], ratio = {} }}
[nodes]
s = {{ velocity = {} }}
)~", Js, Jc, r, w) + simulate_until(1));
  Summary summary;
  const RunTable rows = simulate(scene, &summary);
  // Momentum along the motion w_s = (1 + r) w_c.
  const double after = Js * w * (1 + r) / (Js * (1 + r) * (1 + r) + Jc);
  CHECK(error_of(rows, "c.velocity", [&](double) { return after; }) < 1e-12);
  const double lost = Js * w * w / 2 - (Js * (1 + r) * (1 + r) + Jc) * after * after / 2;
  bool told = false;
  for (const std::string& note : summary.notes) told = told || note.find(fmt::format("lose {:.6g} J", lost)) != note.npos;
  CHECK(told);
}

TEST_CASE("trains: a certified run, a model with a support as its port, and the energy account") {
  const Scene scene = scene_of(R"~(
domain = "rotation"
[models.box]
ports = ["out", "carrier"]
[models.box.elements]
p = { type = "planetary", between = ["s", "carrier", "out"], ratio = 2 }
Js = { type = "inertia", at = "s", inertia = 0.3 }
brake = { type = "slider", between = ["s", "ground"], coulomb = 0.4 }
[elements]
m = { type = "box", between = ["a", "b"] }
Ja = { type = "inertia", at = "a", inertia = 0.5 }
Ta = { type = "torque", at = "a", torque = { sine = 2, frequency = "0.5 Hz" } }
k = { type = "spring", between = ["b", "ground"], stiffness = 20 }
Jb = { type = "inertia", at = "b", inertia = 0.7 }
[simulate]
stop = 3
accuracy = 1e-7
output = { points = 31 }
record = ["m.force", "m.p.force", "Ja.force", "Ta.force", "a.velocity", "k.force", "Jb.force"]
)~");
  const Certificate certificate = certify(scene, {});
  CHECK(certificate.holds);
  const RunTable rows = simulate(scene);
  // The force of the box is that of the ring, at its first port.
  double largest = 0;
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    largest = std::max(largest, std::abs(rows["m.force"][k] - 2 * rows["m.p.force"][k]));
    largest = std::max(largest, std::abs(rows["m.force"][k] + rows["Ja.force"][k] - rows["Ta.force"][k]));
    largest = std::max(largest, std::abs(-3 * rows["m.p.force"][k] + rows["Jb.force"][k] + rows["k.force"][k]));
  }
  CHECK(largest < 1e-9);
}

TEST_CASE("trains: what cannot be is refused by name") {
  const auto message = [](const std::string& elements) { return refusal("domain = \"rotation\"\n[elements]\n" + elements + "[simulate]\nstop = 1\n"); };
  const std::string p = "p = { type = \"planetary\", between = [\"s\", \"c\", \"r\"], ratio = 2 }\n";
  const std::string Js = "Js = { type = \"inertia\", at = \"s\", inertia = 1 }\n", Jc = "Jc = { type = \"inertia\", at = \"c\", inertia = 1 }\n";
  CHECK(message(p + Js) ==
        "too few nodes at transmission `p` have a mass: with losses, with a support that moves, or in a loop with other elements a transmission determines the "
        "motion of one massless node, but here are `r`, `c`; give one of them a mass");
  const auto moves = [](const std::string& node) { return fmt::format("m{0} = {{ type = \"motion\", at = \"{0}\", velocity = 1 }}\n", node); };
  CHECK(message(p + moves("s") + moves("c") + moves("r")) ==
        "transmission `p` is too many: the motion of all its nodes is given: it could only repeat or contradict that; leave it out, or leave one of its nodes free");
  CHECK(message(p + Js + Jc + "q = { type = \"gear\", between = [\"s\", \"c\"], support = \"r\", ratio = 3 }\n") ==
        "transmission `q` is too many: the motion of its nodes follows from `p` already: it could only repeat or contradict that; leave it out");
  CHECK(message(p + Js + Jc + "m = { type = \"motion\", at = \"r\", position = { step = \"0.1 rad\", time = 0.5 } }\n") ==
        "at t = 0.5 s a step in position turns transmission `p` in no time, which takes a force beyond any bound; give the step a time to rise in");
}

}  // namespace rheonet::test::train_test
