// Blocks that close loops with a network, against closed forms; and loops that have no answer at an instant.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::servo_test {

namespace {

/// A + e^(-a t) (C cos(w t) + S sin(w t)) for t > 0 with the given value and slope at 0.
Exact settling(double end, double a, double w, double value, double slope) {
  const double c = value - end, s = (slope + a * c) / w;
  return [=](double t) { return end + std::exp(-a * t) * (c * std::cos(w * t) + s * std::sin(w * t)); };
}

}  // namespace

// J w' + B w = Kp (u - w) + Ki times the integral of that.
TEST_CASE("a rate servo: proportional and integral action on a mass with friction") {
  constexpr double J = 2e-3, B = 3e-3, Kp = 0.04, Ki = 0.9, u = 7, t0 = 0.1;
  const double a = (B + Kp) / (2 * J), w = std::sqrt(Ki / J - a * a);
  const Exact rate = settling(u, a, w, 0, Kp * u / J);
  const auto torque = [=](double t) {
    // J w' + B w, with w' from its own settling oscillation.
    constexpr double h = 1e-6;
    return J * (rate(t + h) - rate(t - h)) / (2 * h) + B * rate(t);
  };
  const std::string text = "domain = \"rotation\"\n" + netlist({{"J", J}, {"B", B}, {"Kp", Kp}, {"Ki", Ki}, {"u", u}, {"t0", t0}}, R"(
[elements]
command  = { type = "generator", signal = { step = "u", time = "t0" } }
error    = { type = "sum", in = ["command", "-shaft.velocity"] }
P        = { type = "gain", in = "error", gain = "Kp" }
I        = { type = "integrator", in = "error", gain = "Ki" }
PI       = { type = "sum", in = ["P", "I"] }
motor    = { type = "torque", at = "shaft", torque = { block = "PI" } }
rotor    = { type = "inertia", at = "shaft", inertia = "J" }
friction = { type = "dashpot", between = ["shaft", "ground"], damping = "B" }
)", 0.6);
  check_at_all_accuracies(text, {{"shaft.velocity", from(t0, rate)},
                                 {"error.out", from(t0, [=](double t) { return u - rate(t); })}});
  check_against(simulate(text, 1e-6), {"motor.force", from(t0, torque)}, 1e-6);
}

// m x'' + B x' = -K (x - u): a spring made of a sensor, a gain and a force.
TEST_CASE("position feedback is a spring") {
  constexpr double m = 1.3, B = 0.7, K = 41, u = 0.02;
  const double a = B / (2 * m), w = std::sqrt(K / m - a * a);
  check_at_all_accuracies(netlist({{"m", m}, {"B", B}, {"K", K}, {"u", u}}, R"(
[elements]
mass  = { type = "mass", at = "x", mass = "m" }
loss  = { type = "dashpot", between = ["x", "ground"], damping = "B" }
away  = { type = "generator", signal = "u" }
error = { type = "sum", in = ["x.position", "-away"] }
back  = { type = "gain", in = "error", gain = "K" }
pull  = { type = "force", at = "x", force = { block = "-back" } }
)", 3), {{"x.position", settling(u, a, w, 0, 0)},
         {"pull.force", [=](double t) { return -K * (settling(u, a, w, 0, 0)(t) - u); }}});
}

// B x' = -K x(t - T) at a massless node, against the method of steps. Forces jump when a jump arrives through the delay.
TEST_CASE("delayed position feedback on a dashpot") {
  constexpr double B = 2.3, K = 1.9, T = 0.7, x0 = 0.4;
  check_at_all_accuracies(netlist({{"B", B}, {"K", K}, {"T", T}, {"x0", x0}}, R"(
[elements]
loss = { type = "dashpot", between = ["x", "ground"], damping = "B" }
late = { type = "delay", in = "x.position", delay = "T", initial = "x0" }
back = { type = "gain", in = "late", gain = "-K" }
pull = { type = "force", at = "x", force = { block = "back" } }
[nodes]
x = { position = "x0" }
)", 4), {{"x.position", [=](double t) {
           double sum = 0, factorial = 1;
           for (int j = 0; t >= (j - 1) * T; ++j) {
             if (j > 0) factorial *= j;
             sum += x0 * std::pow(-K / B * (t - (j - 1) * T), j) / factorial;
           }
           return sum;
         }}});
}

// A load cell: the force of a spring, through a lag, gives the force that relieves it. m v' = F - f, f = k x, T F' + F = -G f.
TEST_CASE("force feedback through a lag, against the same network with the loop solved by hand") {
  constexpr double m = 0.8, k = 55, G = 0.6, T = 0.09, v0 = 1.1;
  const RunTable run = simulate(netlist({{"m", m}, {"k", k}, {"G", G}, {"T", T}, {"v0", v0}}, R"(
[elements]
mass  = { type = "mass", at = "x", mass = "m" }
cell  = { type = "spring", between = ["x", "ground"], stiffness = "k" }
read  = { type = "lag", in = "cell.force", time_constant = "T", gain = "G" }
relief = { type = "force", at = "x", force = { block = "-read" } }
[nodes]
x = { velocity = "v0" }
)", 1.5, 151), 1e-9);
  // A classical Runge-Kutta method with small steps.
  double x = 0, v = v0, F = 0, worst = 0;
  constexpr int inner = 200;
  for (std::size_t row = 0; row < run.time().size(); ++row) {
    worst = std::max({worst, std::abs(run["x.position"][row] - x) / run.scale("x.position"), std::abs(run["read.out"][row] + F) / run.scale("read.out")});
    const double h = 0.01 / inner;
    const auto f = [&](double p, double q, double r) { return std::array{q, (r - k * p) / m, (-G * k * p - r) / T}; };
    for (int i = 0; i < inner; ++i) {
      const auto k1 = f(x, v, F), k2 = f(x + h / 2 * k1[0], v + h / 2 * k1[1], F + h / 2 * k1[2]),
                 k3 = f(x + h / 2 * k2[0], v + h / 2 * k2[1], F + h / 2 * k2[2]), k4 = f(x + h * k3[0], v + h * k3[1], F + h * k3[2]);
      x += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]);
      v += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1]);
      F += h / 6 * (k1[2] + 2 * k2[2] + 2 * k3[2] + k4[2]);
    }
  }
  CHECK(worst < 1e-8);
}

// Velocity feedback between two masses is a dashpot; on sliders it makes them stick and slip as a dashpot does.
TEST_CASE("relative velocity feedback is a dashpot, with friction beside it") {
  const char* const network = R"(
[elements]
a = { type = "mass", at = "a", mass = 1.2 }
b = { type = "mass", at = "b", mass = 0.7 }
k = { type = "spring", between = ["a", "ground"], stiffness = 31 }
l = { type = "spring", between = ["a", "b"], stiffness = 17 }
s = { type = "slider", between = ["b", "ground"], coulomb = 0.4, breakaway = 0.5 }
push = { type = "force", at = "b", force = { square = 2.1, frequency = 0.7 } }
)";
  const std::string rest = "[simulate]\nstop = 6\noutput = { points = 301 }\nrecord = [\"a.position\", \"b.velocity\", \"s.force\"]\n";
  const RunTable passive = simulate(fmt::format("{}c = {{ type = \"dashpot\", between = [\"a\", \"b\"], damping = 0.9 }}\n{}", network, rest), 1e-8);
  const RunTable active = simulate(fmt::format(
      "{}g = {{ type = \"gain\", in = \"l.velocity\", gain = -0.9 }}\n"
      "f = {{ type = \"force\", between = [\"a\", \"b\"], force = {{ block = \"g\" }} }}\n{}", network, rest), 1e-8);
  for (const char* record : {"a.position", "b.velocity"})
    for (std::size_t row = 0; row < active.time().size(); ++row)
      CHECK(std::abs(active[record][row] - passive[record][row]) <= 1e-7 * passive.scale(record));
}

// The controller multiplies a position error by 40, and a limiter keeps its output small. The record of the output needs a more
// accurate position than the record of the position.
TEST_CASE("a recorded output of a block is as accurate as asked, however large the gain before it") {
  const char* const text = R"(
[elements]
cmd  = { type = "generator", signal = { square = 1, frequency = 0.5 } }
late = { type = "delay", in = "x.position", delay = 0.02 }
e    = { type = "sum", in = ["cmd", "-late"] }
P    = { type = "gain", in = "e", gain = 40 }
D    = { type = "gain", in = "-x.velocity", gain = 6 }
I    = { type = "integrator", in = "e", gain = 20 }
u    = { type = "sum", in = ["P", "I", "D"] }
lim  = { type = "limiter", in = "u", upper = 15 }
f    = { type = "force", at = "x", force = { block = "lim" } }
m    = { type = "mass", at = "x", mass = 1 }
s    = { type = "slider", between = ["x", "ground"], coulomb = 2, breakaway = 3 }
[simulate]
stop   = 10
output = { points = 1001 }
record = ["x.position", "x.velocity", "lim.out"]
)";
  const RunTable exact = simulate(text, 1e-11);
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    CHECK(largest_error(simulate(text, accuracy), exact) <= accuracy);
  }
}

TEST_CASE("loops without an answer at an instant are refused") {
  const auto why = [](const std::string& elements) {
    return refusal("[elements]\nm = { type = \"mass\", at = \"x\", mass = 1 }\n" + elements + "\n[simulate]\nstop = 1\n");
  };
  const auto says = [&](const std::string& elements, const std::string& text) {
    const std::string found = why(elements);
    CHECK_MESSAGE(found.find(text) != found.npos, found);
  };
  says("a = { type = \"sum\", in = [\"x.velocity\", \"c\"] }\nb = { type = \"gain\", in = \"a\", gain = 2 }\n"
       "c = { type = \"gain\", in = \"b\", gain = 2 }",
       "blocks `b`, `c` and `a` make a loop in which each needs the output of another at the same instant; put a `lag` into it");
  says("a = { type = \"sum\", in = [\"x.velocity\", \"a\"] }", "block `a` needs its own output at the same instant; put a `lag` between");
  says("a = { type = \"sum\", in = [\"x.velocity\", \"-b\"] }\nb = { type = \"delay\", in = \"a\", delay = 1 }",
       "blocks `b` and `a` make a loop in which nothing but delays takes time, and what jumps would jump for ever; put a `lag` into it");
  says("d = { type = \"dashpot\", between = [\"y\", \"ground\"], damping = 1 }\ng = { type = \"gain\", in = \"y.velocity\", gain = 2 }\n"
       "f = { type = \"force\", at = \"y\", force = { block = \"g\" } }",
       "`f` follows at the same instant from `y.velocity`, which no mass keeps from jumping when a force does: neither can be "
       "known before the other; put a `lag` between them, or give node `y` a mass");
  says("k = { type = \"spring\", between = [\"x\", \"y\"], stiffness = 1 }\nl = { type = \"spring\", between = [\"y\", \"ground\"], stiffness = 1 }\n"
       "g = { type = \"gain\", in = \"l.force\", gain = 2 }\nf = { type = \"force\", at = \"y\", force = { block = \"g\" } }",
       "`f` follows at the same instant from `l.force`, which no mass keeps from jumping when a force does: neither can be known "
       "before the other; put a `lag` between them");
  says("k = { type = \"spring\", between = [\"x\", \"y\"], stiffness = 1 }\nl = { type = \"spring\", between = [\"y\", \"ground\"], stiffness = 1 }\n"
       "g = { type = \"gain\", in = \"y.velocity\", gain = 2 }",
       "no block and no law can depend on `y.velocity`: node `y` has no mass, and no dashpots lead from there to a mass");
  says("s = { type = \"slider\", between = [\"x\", \"ground\"], coulomb = 1 }\ng = { type = \"gain\", in = \"s.force\", gain = 2 }",
       "block `g` cannot take in `s.force`: the force of `s` is what all others at its node leave over; take in that of a "
       "spring or a dashpot beside it");
}

TEST_CASE("a start in steady motion is refused where blocks have none, or look at the motion") {
  const auto why = [](const std::string& elements) {
    return refusal("[elements]\nm = { type = \"mass\", at = \"x\", mass = 1 }\nc = { type = \"dashpot\", between = [\"x\", \"ground\"], damping = 1 }\n" +
                   elements + "\n[simulate]\nstop = 1\nstart_from = \"steady\"\n");
  };
  CHECK(why("g = { type = \"integrator\", in = \"x.velocity\" }").find("block `g` depends on how the network moves") != std::string::npos);
  CHECK(why("u = { type = \"generator\", signal = 2 }\ng = { type = \"integrator\", in = \"u\" }").find("block `g` would go on for ever: its input is not 0") != std::string::npos);
  CHECK(why("u = { type = \"generator\", signal = 2 }\ng = { type = \"lag\", in = \"u\", time_constant = 1 }\nr = { type = \"gain\", in = \"x.velocity\", gain = 1 }") == "");
}

}  // namespace rheonet::test::servo_test
