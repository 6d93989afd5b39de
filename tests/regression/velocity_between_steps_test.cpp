#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/simulate.hpp"

namespace rheonet::test::velocity_between_steps_test {

// Nothing limited the steps on account of a velocity that follows from time alone, through a dashpot to a drive or from a force:
// between steps it was taken from a polynomial, and was off by percents.
TEST_CASE("A velocity that a drive gives through a dashpot is right between steps") {
  // hand - dashpot - n - slider - ground: while it slips, B (V(t) - v) = Fc sgn v.
  const double B = 0.54, Fc = 0.42, X = 0.0837, f = 3.04, omega = 2 * std::numbers::pi * f;
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    const RunTable rows = simulate(scene_of(fmt::format(R"(
[elements]
hand = {{ type = "motion", at = "hand", position = {{ sine = {}, frequency = {} }} }}
c = {{ type = "dashpot", between = ["hand", "n"], damping = {} }}
s = {{ type = "slider", between = ["n", "ground"], coulomb = {} }}
[simulate]
stop = 0.9
output = {{ points = 901 }}
record = ["s.velocity"]
)", X, f, B, Fc), accuracy));
    const std::vector<double>& v = rows["s.velocity"];
    const double most = X * omega - Fc / B;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double V = X * omega * std::cos(omega * rows.time()[i]), size = std::abs(V) - Fc / B;
      CHECK_MESSAGE(std::abs(v[i] - (size > 0 ? std::copysign(size, V) : 0)) <= accuracy * most, rows.time()[i]);
    }
  }
}

TEST_CASE("A velocity that a force gives at a node without mass is right between steps") {
  const double B = 1.7, F = 2.3, f = 1.9, omega = 2 * std::numbers::pi * f;
  const double accuracy = 1e-6;
  const RunTable rows = simulate(scene_of(fmt::format(R"(
[elements]
push = {{ type = "force", at = "n", force = {{ sine = {}, frequency = {} }} }}
c = {{ type = "dashpot", between = ["n", "ground"], damping = {} }}
[simulate]
stop = 2
output = {{ points = 1001 }}
record = ["n.velocity"]
)", F, f, B), accuracy));
  for (std::size_t i = 0; i < rows.time().size(); ++i) {
    CHECK(std::abs(rows["n.velocity"][i] - F / B * std::sin(omega * rows.time()[i])) <= accuracy * F / B);
  }
}

// The positions of both ends were integrated, each to the accuracy of how far it goes.
TEST_CASE("A small slip on a base that goes far is as accurate as it is on one that stays") {
  // A mass on a base, pushed by a short pulse that exceeds friction a little: it slips by a small distance.
  const double m = 0.7, Fc = 1.3, F = 1.3004, T = 0.02, accuracy = 1e-6;
  // While F acts, (F - Fc)/m; then Fc/m against it.
  const double v = (F - Fc) / m * T, slip = v * T / 2 + v * v * m / (2 * Fc);
  for (const double V : {0.0, 0.4, 3.0}) {
    const RunTable rows = simulate(scene_of(fmt::format(R"(
[elements]
base = {{ type = "motion", at = "base", velocity = {} }}
m = {{ type = "mass", at = "n", mass = {} }}
s = {{ type = "slider", between = ["n", "base"], coulomb = {} }}
push = {{ type = "force", at = "n", force = {{ pulse = {}, width = {}, time = 0.5 }} }}
[nodes]
n = {{ velocity = {} }}
[simulate]
stop = 1
output = {{ points = 11 }}
record = ["s.displacement"]
)", V, m, Fc, F, T, V), accuracy));
    CHECK_MESSAGE(std::abs(rows["s.displacement"].back() - slip) <= accuracy * slip, V);
  }
}

}  // namespace rheonet::test::velocity_between_steps_test
