// Up to the event at which its argument changes sign, abs(x) or max(x, 0) is a little below 0: a power of it goes on.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/network/error.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::powers_past_switches_test {

namespace {

constexpr double m = 2, k = 1000, alpha = 0.1, D = 1e-3, F = 8, f = 1.3;

using State = std::array<double, 3>;  // x, v, z

/// Bouc-Wen's hysteresis on a mass, beta = gamma = 1/2.
State rates(double t, const State& s, double n) {
  const auto [x, v, z] = s;
  const double u = std::pow(std::abs(z) / D, n);
  const double bent = (0.5 * std::abs(v) * std::copysign(u, z) + 0.5 * v * u) * D;
  return {v, (F * std::sin(2 * M_PI * f * t) - alpha * k * x - (1 - alpha) * k * z) / m, v - bent / D};
}

/// The displacement at the end, by Runge and Kutta's method with steps of a fixed length.
double reference(double end, double n, int steps) {
  State s{};
  const double h = end / steps;
  const auto ahead = [](const State& from, double by, const State& rate) { return State{from[0] + by * rate[0], from[1] + by * rate[1], from[2] + by * rate[2]}; };
  for (int i = 0; i < steps; ++i) {
    const double t = h * i;
    const State a = rates(t, s, n), b = rates(t + h / 2, ahead(s, h / 2, a), n), c = rates(t + h / 2, ahead(s, h / 2, b), n), d = rates(t + h, ahead(s, h, c), n);
    for (std::size_t j = 0; j < s.size(); ++j) s[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
  }
  return s[0];
}

}  // namespace

TEST_CASE("Bouc-Wen's law with a power between 1 and 3 passes the zeros of its state") {
  for (const double n : {1.1, 1.5, 2.5}) {
    CAPTURE(n);
    const RunTable run = simulate(fmt::format(R"(include = ["library/friction.toml"]
[elements]
m = {{ type = "mass",  at = "x", mass = {} }}
f = {{ type = "force", at = "x", force = {{ sine = {}, frequency = {} }} }}
r = {{ type = "bouc-wen", between = ["x", "ground"], n = {} }}
[simulate]
stop = 3
output = {{ points = 31 }}
record = ["x.position"]
)", m, F, f, n), 1e-7);
    CHECK(std::abs(run["x.position"].back() - reference(3, n, 300'000)) <= 1e-5 * run.scale("x.position"));
  }
}

// The power takes in what another function gives: the definition of a law, or another block.
TEST_CASE("powers of what other functions give pass its zeros") {
  const auto scene = [](const std::string& laws, const std::string& contact) {
    return simulate(R"([parameters]
K = "1e3 N"
L = "1 m"
)" + laws + R"(
[elements]
m = { type = "mass", at = "x", mass = 2 }
k = { type = "spring", between = ["x", "ground"], stiffness = 40 }
F = { type = "force", at = "x", force = { sine = "6 N", frequency = "0.7 Hz", phase = "0.3 rad" } }
)" + contact + R"(
[nodes]
x = { velocity = "0.5 m/s" }
[simulate]
stop = 4
record = ["x.position"]
)", 1e-8);
  };
  const std::string at_x = "q = { type = \"q\", between = [\"x\", \"ground\"] }";
  const RunTable whole = scene("[laws.q]\nparameters = { K = \"1e3 N\", L = \"1 m\" }\nforce = \"K*max(d/L, 0)^1.5\"", at_x);
  for (const char* law : {"where = { h = \"max(d/L, 0)\" }\nforce = \"K*h^1.5\"", "where = { h = \"d > 0 ? d/L : 0\" }\nforce = \"K*h*sqrt(h)\"",
                          "where = { g = \"max(d/L, 0)\", h = \"g/2\" }\nforce = \"2^1.5*K*h^1.5\""}) {
    CAPTURE(law);
    const RunTable run = scene(std::string("[laws.q]\nparameters = { K = \"1e3 N\", L = \"1 m\" }\n") + law, at_x);
    for (std::size_t row = 0; row < run.time().size(); ++row) CHECK_LE(std::abs(run["x.position"][row] - whole["x.position"][row]), 1e-7 * whole.scale("x.position"));
  }
  const RunTable blocks = scene("", "h = { type = \"function\", in = [\"x.position\"], out = \"max(u1/L, 0)\" }\n"
                                    "p = { type = \"function\", in = [\"h\"], out = \"-K*u1^1.5\" }\nq = { type = \"force\", at = \"x\", force = { block = \"p\" } }");
  for (std::size_t row = 0; row < blocks.time().size(); ++row) CHECK_LE(std::abs(blocks["x.position"][row] - whole["x.position"][row]), 1e-7 * whole.scale("x.position"));
}

// A ball meets Hertz' contact: the force k d^(3/2) of its penetration d.
TEST_CASE("Hertz' contact gives the largest penetration and the velocity of the rebound, however its law is written") {
  constexpr double mass = 0.05, stiffness = 1e5, v = 0.3, gap = 0.01;
  for (const char* force : {"k*max(d, 0)^1.5", "d > 0 ? k*d^1.5 : 0", "k*max(d, 0)*sqrt(max(d, 0))", "k*((d + abs(d))/2)^1.5"}) {
    CAPTURE(force);
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(accuracy);
      const RunTable run = simulate(fmt::format(R"([laws.hertz]
parameters = {{ k = "1e5 N/m^1.5" }}
force = "{}"
stores = "0.4*k*max(d, 0)^2.5"
[nodes]
ball = {{ position = {}, velocity = {} }}
[elements]
m = {{ type = "mass", at = "ball", mass = {} }}
c = {{ type = "hertz", between = ["ball", "ground"] }}
[simulate]
stop = 0.06
output = {{ points = 6001 }}
record = ["ball.position", "ball.velocity", "c.energy"]
)", force, -gap, v, mass), accuracy);
      // All of the kinetic energy is in the contact at the largest penetration.
      const double deepest = std::pow(mass * v * v / 2 / (0.4 * stiffness), 0.4);
      const std::vector<double>& position = run["ball.position"];
      CHECK(*std::max_element(position.begin(), position.end()) == doctest::Approx(deepest).epsilon(std::max(20 * accuracy, 1e-4)));
      CHECK(run["ball.velocity"].back() == doctest::Approx(-v).epsilon(20 * accuracy));
    }
  }
}

TEST_CASE("a root of a magnitude passes its zero, and a root of what is negative is refused") {
  const auto netlist = [](const std::string& root) {
    return "[laws.rough]\nparameters = { k = \"100 N/m\", c = \"1 N*s^1.5/m^1.5\" }\nforce = \"k*d + c*" + root + "\"\n[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\nr = { type = \"rough\", between = [\"a\", \"ground\"] }\n"
           "f = { type = \"force\", at = \"a\", force = { sine = 2, frequency = 0.7 } }\n[simulate]\nstop = 4\noutput = { points = 5 }\n";
  };
  CHECK_NOTHROW(simulate(netlist("w*sqrt(abs(w))"), 1e-6));
  CHECK_THROWS_WITH_AS(simulate(netlist("w*sqrt(w)"), 1e-6), doctest::Contains("has no finite value"), SimulationError);
}

}  // namespace rheonet::test::powers_past_switches_test
