// Springs and dashpots whose force is given over the displacement or the velocity.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::characteristic_test {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

// A spring that is soft up to a corner and hard beyond it: two arcs of oscillators.
TEST_CASE("characteristic: a mass on a spring of two stiffnesses") {
  const double k1 = 71, k2 = 830, corner = 0.023, m = 1.3, v0 = 0.71;
  const double soft = std::sqrt(k1 / m), hard = std::sqrt(k2 / m);
  // x = v0/soft sin(soft t) up to the corner at t1, with the velocity v1 there.
  const double t1 = std::asin(corner * soft / v0) / soft, v1 = v0 * std::cos(soft * t1);
  // Beyond it m x'' = -k1 corner - k2 (x - corner): an oscillator about corner - k1/k2 corner.
  const double centre = corner - k1 / k2 * corner, amplitude = std::hypot(corner - centre, v1 / hard), phase = std::atan2(corner - centre, v1 / hard);
  const double stay = (pi - 2 * phase) / hard, t2 = t1 + stay, half = 2 * t1 + stay;
  const auto first_half = [=](double t) {
    if (t < t1) return v0 / soft * std::sin(soft * t);
    if (t < t2) return centre + amplitude * std::sin(hard * (t - t1) + phase);
    return v0 / soft * std::sin(soft * (half - t));
  };
  // The table is the same on both sides; the second half is the mirror image of the first.
  const auto x = [=](double t) {
    const double u = std::fmod(t, 2 * half);
    return u < half ? first_half(u) : -first_half(u - half);
  };
  const auto force = [=](double t) { return std::abs(x(t)) < corner ? k1 * x(t) : std::copysign(k1 * corner + k2 * (std::abs(x(t)) - corner), x(t)); };
  const auto energy = [=](double t) {
    const double d = std::min(std::abs(x(t)), corner), more = std::abs(x(t)) - d;
    return k1 * d * d / 2 + more * (k1 * corner + k2 * more / 2);
  };
  const Expectations expected = {{"x.position", x}, {"s.force", force}, {"s.energy", energy}};
  // The rest length shifts the displacement; points along a straight line are no corners.
  for (const double rest : {0.0, 0.17}) {
    check_at_all_accuracies(netlist({{"k1", k1}, {"k2", k2}, {"c", corner}, {"m", m}, {"v0", v0}, {"rest", rest}}, R"(
[nodes]
x = { velocity = "v0" }
base = { position = "-rest" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
hold = { type = "motion", at = "base", velocity = 0 }
s = { type = "spring", between = ["x", "base"], rest = "rest", force = [["-2*c", "-k1*c - k2*c"], ["-c", "-k1*c"], ["c/3", "k1*c/3"], ["c", "k1*c"], ["1.1*c", "k1*c + k2*c*0.1"], ["3*c", "k1*c + 2*k2*c"]] }
)", 1.37 * 2 * half) + record(expected), expected);
  }
}

TEST_CASE("characteristic: a straight one is a linear spring or dashpot") {
  const auto scene = [](const std::string& spring, const std::string& dashpot) {
    return simulate(netlist({}, fmt::format(R"(
[nodes]
x = {{ position = 0.02, velocity = -0.31 }}
[elements]
drive = {{ type = "motion", at = "a", velocity = {{ sine = 0.3, frequency = 0.7 }} }}
m = {{ type = "mass", at = "x", mass = 1.3 }}
k = {{ type = "spring", between = ["x", "n"], {} }}
c = {{ type = "dashpot", between = ["n", "a"], {} }}
)", spring, dashpot), 1.9), 1e-9);
  };
  const RunTable linear = scene("stiffness = 210", "damping = 37");
  CHECK_LT(largest_error(scene("force = [[-0.1, -21], [0.2, 42]]", "damping = 37"), linear), 1e-8);
  CHECK_LT(largest_error(scene("stiffness = 210", "force = [[-1, -37], [0, 0], [2, 74]]"), linear), 1e-8);
  CHECK_LT(largest_error(scene("force = { table = [[-0.1, -21], [0, 0], [0.2, 42]], smooth = true }", "force = [[-1, -37], [2, 74]], smooth = true"), linear), 1e-8);
}

// A damper with a blow-off valve: c1 up to w1, then c2. A mass slows down: two exponentials.
TEST_CASE("characteristic: a mass on a dashpot of two slopes") {
  const double c1 = 11, c2 = 1.7, w1 = 0.43, m = 0.9, v0 = 3.1, lift = (c1 - c2) * w1;  // f = lift + c2 w beyond w1
  const double t1 = m / c2 * std::log((v0 + lift / c2) / (w1 + lift / c2));
  const auto v = [=](double t) { return t < t1 ? (v0 + lift / c2) * std::exp(-c2 / m * t) - lift / c2 : w1 * std::exp(-c1 / m * (t - t1)); };
  const auto force = [=](double t) { return v(t) > w1 ? lift + c2 * v(t) : c1 * v(t); };
  for (const double s : {1.0, -1.0}) {
    const Expectations expected = {{"x.velocity", [&](double t) { return s * v(t); }}, {"d.force", [&](double t) { return s * force(t); }},
                                   {"d.dissipated", [&](double t) { return force(t) * v(t); }}};
    check_at_all_accuracies(netlist({{"c1", c1}, {"c2", c2}, {"w1", w1}, {"m", m}, {"v0", s * v0}}, R"(
[nodes]
x = { velocity = "v0" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
d = { type = "dashpot", between = ["x", "ground"], force = [["-2*w1", "-c1*w1 - c2*w1"], ["-w1", "-c1*w1"], ["w1", "c1*w1"], ["2*w1", "c1*w1 + c2*w1"]] }
)", 1.7 * t1) + record(expected), expected);
  }
}

// Without masses: a spring relaxes through such a dashpot, p' = -w(k p).
TEST_CASE("characteristic: a spring relaxes through a dashpot of two slopes, and one that saturates carries no more") {
  const double k = 130, c1 = 11, c2 = 1.7, w1 = 0.43, lift = (c1 - c2) * w1, f0 = 9.3;
  // Beyond w1: c2 w = f - lift, f' = -k w.
  const double t1 = c2 / k * std::log((f0 - lift) / (c1 * w1 - lift));
  const auto force = [=](double t) { return t < t1 ? lift + (f0 - lift) * std::exp(-k / c2 * t) : c1 * w1 * std::exp(-k / c1 * (t - t1)); };
  const Expectations expected = {{"s.force", force}, {"d.force", [=](double t) { return -force(t); }}};
  check_at_all_accuracies(netlist({{"c1", c1}, {"c2", c2}, {"w1", w1}, {"k", k}, {"f0", f0}}, R"(
[elements]
s = { type = "spring", between = ["ground", "n"], stiffness = "k", f0 = "-f0" }
d = { type = "dashpot", between = ["n", "ground"], force = [["-2*w1", "-c1*w1 - c2*w1"], ["-w1", "-c1*w1"], ["w1", "c1*w1"], ["2*w1", "c1*w1 + c2*w1"]] }
)", 4 * t1) + record({{"s.force", force}}), {{"s.force", [=](double t) { return -force(t); }}});

  // A base moves on at V: the force rises to the bound of the damper, and its node follows the base.
  const double most = 5.2, V = 2.1;
  const std::string toml = netlist({{"most", most}, {"w1", w1}, {"k", k}, {"V", V}}, R"(
[elements]
drive = { type = "motion", at = "a", velocity = "V" }
s = { type = "spring", between = ["a", "n"], stiffness = "k" }
d = { type = "dashpot", between = ["n", "ground"], force = [["-2*w1", "-most"], ["-w1", "-most"], ["w1", "most"], ["2*w1", "1.01*most"]] }
)", 2.0);
  const double c = most / w1, flat = 0.01 * most / w1, t2 = -c / k * std::log(1 - w1 / V);  // f = c V (1 - exp(-k t/c)) up to most
  const auto rises = [=](double t) {
    if (t < t2) return c * V * -std::expm1(-k * t / c);
    const double end = most + flat * (V - w1);  // steady: w = V
    return end + (most - end) * std::exp(-k / flat * (t - t2));
  };
  check_at_all_accuracies(toml, {{"d.force", rises}});
}

TEST_CASE("characteristic: steady motion and rest on a curve") {
  const double ks = 71, F = 7.7;
  const Expectations rest = {{"x.position", [=](double) { return 0.02 + (F - 3) / 700; }}};
  check_at_all_accuracies(netlist({{"F", F}, {"ks", ks}}, R"(
[elements]
mass = { type = "mass", at = "x", mass = 1.3 }
load = { type = "force", at = "x", force = "F" }
s = { type = "spring", between = ["x", "ground"], force = [[0, 0], [0.02, 3], [0.03, 10]] }
)", 1.0) + "start_from = \"rest\"\n" + record(rest), rest);

  const Expectations steady = {{"x.velocity", [=](double) { return 0.5 + (F - 3) / 8; }}};
  check_at_all_accuracies(netlist({{"F", F}}, R"(
[elements]
mass = { type = "mass", at = "x", mass = 1.3 }
load = { type = "force", at = "x", force = "F" }
d = { type = "dashpot", between = ["x", "ground"], force = [[-1, -4], [0, 0], [0.5, 3], [1, 7]] }
)", 1.0) + "start_from = \"steady\"\n" + record(steady), steady);
}

// The first integral of m x'' = -k1 x - k3 x^3 gives the velocity at each place, and the energy in the spring.
TEST_CASE("characteristic: a cubic spring by an expression") {
  const double k1 = 71, k3 = 9.1e4, m = 1.3, v0 = 1.9;
  const auto work = [=](double x) { return k1 * x * x / 2 + k3 * x * x * x * x / 4; };
  const std::string toml = R"(
[parameters]
k1 = "71 N/m"
k3 = "9.1e4 N/m^3"
[nodes]
x = { velocity = 1.9 }
[elements]
mass = { type = "mass", at = "x", mass = 1.3 }
s = { type = "spring", between = ["x", "ground"], force = "k1*d + k3*d^3" }
[simulate]
stop = 2
output = { points = 201 }
record = ["x.position", "x.velocity", "s.force", "s.energy"]
)";
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(toml, accuracy);
    const double energy = m * v0 * v0 / 2;
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      const double x = rows["x.position"][row], v = rows["x.velocity"][row];
      CHECK_LE(std::abs(m * v * v / 2 + work(x) - energy), 30 * accuracy * energy);
      CHECK_LE(std::abs(rows["s.force"][row] - (k1 * x + k3 * x * x * x)), 1e-9 * rows.scale("s.force"));
      CHECK_LE(std::abs(rows["s.energy"][row] - work(x)), 1e-9 * energy);
    }
    CHECK_GT(rows.scale("x.position"), 0.05);
  }
}

// An eddy-current brake: f = 2 F/(w/w1 + w1/w) falls beyond w1. m w' = -f: (w^2 - v0^2)/2 + w1^2 ln(w/v0) = -2 F w1 t/m.
TEST_CASE("characteristic: a brake whose force falls with the speed") {
  const double F = 3.3, w1 = 0.7, m = 1.9, v0 = 4.1;
  const std::string toml = R"_(
[parameters]
F = "3.3 N"
w1 = "0.7 m/s"
[nodes]
x = { velocity = 4.1 }
[elements]
mass = { type = "mass", at = "x", mass = 1.9 }
d = { type = "dashpot", between = ["x", "ground"], force = "2*F*w*w1/(w^2 + w1^2)" }
[simulate]
stop = 7
output = { points = 201 }
)_";
  for (const double accuracy : accuracies) {
    const RunTable rows = simulate(toml, accuracy);
    for (std::size_t row = 1; row < rows.time().size(); ++row) {
      const double w = rows["x.velocity"][row], t = rows.time()[row];
      if (w < 100 * accuracy * v0) break;  // it slows down exponentially
      const double when = m / (2 * F * w1) * ((v0 * v0 - w * w) / 2 + w1 * w1 * std::log(v0 / w));
      // The error of the velocity as one of the time at which it would be right.
      CHECK_LE(std::abs(when - t), 10 * accuracy * v0 * m / (2 * F * w1) * (w + w1 * w1 / w));
    }
  }
  const std::string massless = "[parameters]\nF = \"3.3 N\"\nw1 = \"0.7 m/s\"\n[elements]\nm = { type = \"motion\", at = \"a\", velocity = 1 }\n"
                               "s = { type = \"spring\", between = [\"a\", \"n\"], stiffness = 3 }\n"
                               "d = { type = \"dashpot\", between = [\"n\", \"ground\"], force = \"2*F*w*w1/(w^2 + w1^2)\" }\n[simulate]\nstop = 1\n";
  CHECK(refusal(massless).find("node `n` has no mass") != std::string::npos);
}

TEST_CASE("characteristic: parts of a scene are told apart beside such a dashpot") {
  const RunTable rows = simulate(R"(
[nodes]
a = { velocity = 1 }
[elements]
d = { type = "dashpot", between = ["a", "b"], force = [["-1 m/s", "-900 N"], [0, 0]] }
m = { type = "mass", at = "a", mass = 3 }
n = { type = "mass", at = "b", mass = 5 }
other = { type = "mass", at = "c", mass = 49 }
[simulate]
stop = 1
)", 1e-6);
  CHECK_EQ(rows["a.velocity"].back(), doctest::Approx(3.0 / 8));
}

TEST_CASE("characteristic: mistakes are refused") {
  const auto says = [](const std::string& element, const std::string& words) {
    const std::string text = refusal("[elements]\nm = { type = \"mass\", at = \"x\", mass = 1 }\ns = { between = [\"x\", \"ground\"], " + element + " }\n[simulate]\nstop = 1\n");
    CHECK_MESSAGE((words.empty() ? text.empty() : text.find(words) != std::string::npos), element << ": " << text);
  };
  says("type = \"spring\"", "needs `stiffness` or `force`");
  says("type = \"spring\", stiffness = 1, force = [[0, 0], [1, 1]]", "`stiffness`");
  says("type = \"spring\", force = [[0, 0]]", "needs at least two points");
  says("type = \"spring\", force = [[0, 0], [0, 1]]", "points of increasing displacement, but 0 follows 0");
  says("type = \"spring\", force = [[0, 0], [-1, 1]]", "but -1 follows 0");
  says("type = \"spring\", force = [[0, 0], [1]]", "array of two values");
  says("type = \"spring\", force = [[0, 0], [\"1 s\", 1]]", "the displacement of a point");
  says("type = \"spring\", force = [[0, 0], [1, \"1 m\"]]", "the force of a point");
  says("type = \"spring\", force = 3", "array of points");
  says("type = \"spring\", force = { points = [[0, 0], [1, 1]] }", "table");
  says("type = \"spring\", force = \"no-such.csv\"", "no-such.csv");
  says("type = \"dashpot\", force = [[0, 0], [1, -2]]", "is -2 at a velocity of 1: it must resist");
  says("type = \"dashpot\", force = [[-1, 2], [0, 0]]", "is 2 at a velocity of -1: it must resist");
  says("type = \"dashpot\", force = [[-1, 1], [1, 2]]", "is 1 at a velocity of -1: it must resist");
  says("type = \"dashpot\", force = [[1, 1], [2, 3]]", "is -1 at a velocity of 0, where it must be 0");
  says("type = \"dashpot\", force = [[0, 0], [1, 2]], smooth = 1", "`smooth`");
  says("type = \"spring\", force = [[0, 0], [1, 2], [2, 1]]", "");
  says("type = \"dashpot\", force = [[0, 0], [1, 2], [2, 1]]", "");
  says("type = \"spring\", force = [[0, 0], [1, 2]], f0 = 1", "");
  says("type = \"spring\", force = \"3*w\"", "`w`");
  says("type = \"dashpot\", force = \"sign(w)*1\"", "force");
  says("type = \"spring\", force = [[0, 0], [1, 2], [2, 1], [3, 1]], f0 = 1.5", "may have at several displacements");
  says("type = \"spring\", force = [[0, 0], [1, 2], [2, 2]], f0 = 3", "never has");
  says("type = \"spring\", force = \"d\"", "force");
  says("type = \"spring\", force = \"1\"", "does not depend on `d`");
}

}  // namespace rheonet::test::characteristic_test
