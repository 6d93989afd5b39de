// Inerters: f = b dw/dt. They add to masses without weight at a node, pass on jumps of velocity, and couple masses.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/check.hpp"
#include "tests/support/response.hpp"

namespace rheonet::test::inerter_test {

namespace {

constexpr double m = 1.73, b = 0.87, k = 219.7, stop = 1.117;

Response oscillation(double omega, double x0, double v0) {
  return Response().second_order(Response::Complex(0, omega), Response::Complex(0, -omega), x0, v0);
}

}  // namespace

TEST_CASE("an inerter to ground adds its inertance to the mass") {
  const double x0 = 0.0317, v0 = -0.841;
  const Response x = oscillation(std::sqrt(k / (m + b)), x0, v0), a = x.derivative().derivative();
  const Expectations expected = {{"end.position", x}, {"end.velocity", x.derivative()}, {"inerter.force", -b * a},
                                 {"mass.force", m * a}, {"spring.force", k * x}};
  check_at_all_accuracies(netlist({{"m", m}, {"b", b}, {"k", k}}, fmt::format(R"(
[nodes]
end = {{ position = {}, velocity = {} }}
[elements]
mass    = {{ type = "mass", at = "end", mass = "m" }}
spring  = {{ type = "spring", between = ["end", "ground"], stiffness = "k" }}
inerter = {{ type = "inerter", between = ["ground", "end"], inertance = "b" }}
)", x0, v0), stop) + record(expected), expected);
}

TEST_CASE("two masses, a spring and an inerter between them, in a moving frame") {
  const double m2 = 2.91, reduced = m * m2 / (m + m2), w0 = 1.37;
  for (const double frame : {0.0, 13.1}) {
    // The centre of mass goes on; the relative motion has the reduced mass and the inertance.
    const Response d = oscillation(std::sqrt(k / (reduced + b)), 0, w0), w = d.derivative();
    const double centre = m * w0 / (m + m2) + frame;
    const Response v1 = Response::constant(centre) + m2 / (m + m2) * w, v2 = Response::constant(centre) - m / (m + m2) * w;
    const Expectations expected = {{"one.velocity", v1}, {"two.velocity", v2}, {"inerter.force", b * w.derivative()},
                                   {"spring.force", k * d}, {"inerter.displacement", d}};
    check_at_all_accuracies(netlist({{"m", m}, {"m2", m2}, {"b", b}, {"k", k}}, fmt::format(R"(
[nodes]
one = {{ velocity = {} }}
two = {{ velocity = {} }}
[elements]
m1      = {{ type = "mass", at = "one", mass = "m" }}
m2      = {{ type = "mass", at = "two", mass = "m2" }}
spring  = {{ type = "spring", between = ["one", "two"], stiffness = "k" }}
inerter = {{ type = "inerter", between = ["one", "two"], inertance = "b" }}
)", w0 + frame, frame), stop) + record(expected), expected);
  }
}

TEST_CASE("between prescribed motions an inerter's force is b times the relative acceleration") {
  const double A = 0.0217, omega = 2 * std::numbers::pi * 2.9, rise = 0.731;
  const Response a = -A * omega * omega * Response::sine(1, omega);
  const Expectations expected = {{"inerter.force", b * (a - Response::constant(rise))}, {"shake.force", b * (a - Response::constant(rise))}};
  check_at_all_accuracies(netlist({{"b", b}}, fmt::format(R"(
[elements]
shake   = {{ type = "motion", at = "one", position = {{ sine = {}, frequency = 2.9 }} }}
pull    = {{ type = "motion", at = "two", velocity = {{ ramp = {} }} }}
inerter = {{ type = "inerter", between = ["one", "two"], inertance = "b" }}
)", A, rise), stop) + record(expected), expected);
}

TEST_CASE("a jump of velocity passes through inerters, shared as their inertances and masses say") {
  const double V = 0.731, c = 2.37, t0 = 0.0513;
  SUBCASE("to a massless node before a dashpot: all of it") {
    const Response v = V * Response::constant(1) - V * Response::constant(1).lag(b / c, 0);  // V exp(-c t/b)
    const Expectations expected = {{"n.velocity", from(t0, v)}, {"inerter.force", from(t0, c * v)}};
    check_at_all_accuracies(netlist({{"b", b}, {"c", c}}, fmt::format(R"(
[elements]
drive   = {{ type = "motion", at = "end", velocity = {{ step = {}, time = {} }} }}
inerter = {{ type = "inerter", between = ["end", "n"], inertance = "b" }}
dashpot = {{ type = "dashpot", between = ["n", "ground"], damping = "c" }}
)", V, t0), stop) + record(expected), expected);
  }
  SUBCASE("to two masses in a row: the mass matrix says how") {
    const double m2 = 2.91, b2 = 0.59;  // M = [m + b + b2, -b2; -b2, m2 + b2], M dv = [b V, 0]
    const double det = (m + b + b2) * (m2 + b2) - b2 * b2;
    const double v1 = (m2 + b2) * b * V / det, v2 = b2 * b * V / det;
    const auto step = [&](double v) { return from(t0, [v](double) { return v; }); };
    const Expectations expected = {{"one.velocity", step(v1)}, {"two.velocity", step(v2)}, {"inner.velocity", step(v1 - v2)}};
    check_at_all_accuracies(netlist({{"b", b}, {"b2", b2}, {"m", m}, {"m2", m2}}, fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "end", velocity = {{ step = {}, time = {} }} }}
outer = {{ type = "inerter", between = ["end", "one"], inertance = "b" }}
m1    = {{ type = "mass", at = "one", mass = "m" }}
inner = {{ type = "inerter", between = ["one", "two"], inertance = "b2" }}
m2    = {{ type = "mass", at = "two", mass = "m2" }}
)", V, t0), stop) + record(expected), expected);
  }
  SUBCASE("a step in position pushes a mass through a dashpot, and the mass another one through an inerter") {
    const double m2 = 2.91, dx = 0.0137, push = c * dx;  // impulse [N s]
    const double det = (m + b) * (m2 + b) - b * b, v1 = (m2 + b) * push / det, v2 = b * push / det;
    // Afterwards the dashpot brakes: M dv/dt = [-c v1, 0]. Both velocities keep to the eigenvector of M^-1 diag(c, 0).
    const double rate = c * (m2 + b) / det;
    const auto fall = [&](double v) { return from(t0, [=](double t) { return v * std::exp(-rate * t); }); };
    const Expectations expected = {{"one.velocity", fall(v1)}, {"two.velocity", fall(v2)}};
    check_at_all_accuracies(netlist({{"b", b}, {"c", c}, {"m", m}, {"m2", m2}}, fmt::format(R"(
[elements]
drive   = {{ type = "motion", at = "end", position = {{ step = {}, time = {} }} }}
dashpot = {{ type = "dashpot", between = ["end", "one"], damping = "c" }}
m1      = {{ type = "mass", at = "one", mass = "m" }}
inerter = {{ type = "inerter", between = ["one", "two"], inertance = "b" }}
m2      = {{ type = "mass", at = "two", mass = "m2" }}
)", dx, t0), stop) + record(expected), expected);
  }
}

TEST_CASE("friction stops a mass with an inerter later, and both sides of breaking away are those of the balance") {
  const double Fc = 2.37, v0 = 0.841, rest = (m + b) * v0 / Fc;
  const auto v = [&](double t) { return t < rest ? v0 - Fc * t / (m + b) : 0; };
  const Expectations expected = {{"end.velocity", v},
                                 {"inerter.force", [&](double t) { return t < rest ? -b * Fc / (m + b) : 0; }},
                                 {"slider.force", [&](double t) { return t < rest ? Fc : 0; }, Fc}};
  check_at_all_accuracies(netlist({{"m", m}, {"b", b}, {"Fc", Fc}}, fmt::format(R"(
[nodes]
end = {{ velocity = {} }}
[elements]
mass    = {{ type = "mass", at = "end", mass = "m" }}
inerter = {{ type = "inerter", between = ["end", "ground"], inertance = "b" }}
slider  = {{ type = "slider", between = ["end", "ground"], coulomb = "Fc" }}
)", v0), 1.9 * rest) + record(expected), expected);

  // A massless node between an inerter and a slider: the accelerating base slips it as soon as b a exceeds the bound.
  for (const double share : {0.97, 1.03}) {
    const double a = share * Fc / b;  // the base's acceleration
    const Response slips = Response::ramp(std::max(0.0, a - Fc / b));
    const Expectations moved = {{"n.velocity", slips, a * stop}, {"slider.force", Response::constant(std::min(b * a, Fc))}};
    check_at_all_accuracies(netlist({{"b", b}, {"Fc", Fc}, {"a", a}}, R"(
[elements]
drive   = { type = "motion", at = "end", velocity = { ramp = "a" } }
inerter = { type = "inerter", between = ["end", "n"], inertance = "b" }
slider  = { type = "slider", between = ["n", "ground"], coulomb = "Fc" }
)", stop) + record(moved), moved);
  }
}

TEST_CASE("inerters that nothing can follow are refused") {
  const auto says = [](const std::string& elements) {
    return refusal("[elements]\n" + elements + "[simulate]\nstop = 1\n");
  };
  CHECK_MESSAGE(says("f = { type = \"force\", at = \"a\", force = 1 }\nk = { type = \"spring\", between = [\"b\", \"ground\"], stiffness = 1 }\n"
                     "i = { type = \"inerter\", between = [\"a\", \"b\"], inertance = 1 }\n")
                    .find("inerter `i` and those joined to it end at nodes without a mass alone, whose common velocity nothing determines; "
                          "give node `a` or `b` a mass") != std::string::npos,
                says("f = { type = \"force\", at = \"a\", force = 1 }\nk = { type = \"spring\", between = [\"b\", \"ground\"], stiffness = 1 }\n"
                     "i = { type = \"inerter\", between = [\"a\", \"b\"], inertance = 1 }\n"));
  CHECK_MESSAGE(says("x = { type = \"motion\", at = \"a\", position = { step = 0.25, time = 0.5 } }\n"
                     "i = { type = \"inerter\", between = [\"a\", \"b\"], inertance = 1 }\nm = { type = \"mass\", at = \"b\", mass = 1 }\n")
                    .find("at t = 0.5 s a step in position stretches inerter `i` by 0.25 m in no time, which takes a force beyond any bound; "
                          "give the step a time to rise in") != std::string::npos,
                "a step in position");
  CHECK_MESSAGE(says("m = { type = \"mass\", at = \"b\", mass = 1 }\nl = { type = \"lag\", in = \"b.velocity\", time_constant = 1 }\n"
                     "x = { type = \"motion\", at = \"a\", velocity = { block = \"l\" } }\n"
                     "i = { type = \"inerter\", between = [\"a\", \"b\"], inertance = 1 }\n")
                    .find("inerter `i` ends at node `a`, which a block moves") != std::string::npos,
                "moved by a block");
}

// m a1 = b (a - a1): the mass follows with the share b/(m + b) of a given acceleration.
TEST_CASE("an inerter passes on an acceleration that is given as such") {
  const double a = 1.7, f = 0.43, share = b / (m + b), omega = 2 * std::numbers::pi * f;
  const auto v = [=](double t) { return a / omega * (1 - std::cos(omega * t)); };
  const Expectations expected = {{"one.velocity", [=](double t) { return share * v(t); }},
                                 {"outer.force", [=](double t) { return m * share * a * std::sin(omega * t); }},
                                 {"drive.force", [=](double t) { return m * share * a * std::sin(omega * t); }}};
  check_at_all_accuracies(netlist({{"b", b}, {"m", m}, {"a", a}}, fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "end", acceleration = {{ sine = "a", frequency = {} }} }}
outer = {{ type = "inerter", between = ["end", "one"], inertance = "b" }}
m1    = {{ type = "mass", at = "one", mass = "m" }}
)", f), 3.1) + record(expected), expected);
}

// An inerter to ground is a mass, also where a rigid stop joins two nodes of a planetary gear, and with them the third. Forces between the
// nodes keep M1 a + M2 b + M3 c; a plastic impact joins all, another one parts the two with e times their speed.
TEST_CASE("an inerter to ground at a planetary gear takes impulses as a mass does") {
  const double M1 = 2.1, M2 = 1.3, M3 = 2.9, i = 2, va = -0.5, vc = 0.85, vb = (va + i * vc) / (1 + i);
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const int inerter : {0, 1, 2}) {
      for (const bool forwards : {true, false}) {
        CAPTURE(e);
        CAPTURE(inerter);
        CAPTURE(forwards);
        const auto inertia = [&](int place, const char* node, double size) {
          return place == inerter ? fmt::format("m{0} = {{ type = \"inerter\", between = [\"{0}\", \"ground\"], inertance = {1} }}\n", node, size)
                                  : fmt::format("m{0} = {{ type = \"mass\", at = \"{0}\", mass = {1} }}\n", node, size);
        };
        const RunTable rows = simulate(fmt::format(R"(
[nodes]
a = {{ velocity = {:.17g} }}
b = {{ velocity = {:.17g} }}
c = {{ velocity = {:.17g} }}
[elements]
pl = {{ type = "planetary", between = ["a", "b", "c"], ratio = {} }}
st = {{ type = "stop", between = {}, stiffness = "inf", restitution = {} }}
{}{}{}
[simulate]
stop = 2
output = {{ points = 5 }}
record = ["a.velocity", "b.velocity", "c.velocity"]
)", va, vb, vc, i, forwards ? "[\"a\", \"b\"], lower = -0.2" : "[\"b\", \"a\"], upper = 0.2", e, inertia(0, "a", M1), inertia(1, "b", M2), inertia(2, "c", M3)));
        const double a = rows["a.velocity"].back(), v = rows["b.velocity"].back(), c = rows["c.velocity"].back();
        CHECK_LE(std::abs(M1 * (a - va) + M2 * (v - vb) + M3 * (c - vc)), 1e-14);
        CHECK_LE(std::abs(a - v + e * (va - vb)), 1e-14);
        CHECK_LE(std::abs(a + i * c - (1 + i) * v), 1e-14);
      }
    }
  }
}

}  // namespace rheonet::test::inerter_test
