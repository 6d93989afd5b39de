// Friction whose force falls from breakaway to sliding within some speed (Stribeck), and sticking that stays exact.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/analytic/slider_checks.hpp"
#include "tests/support/random.hpp"

namespace rheonet::test::stribeck_test {

namespace {

constexpr double Fc = 2.3, Fs = 3.7, vs = 0.031;

double stribeck(double w, double shape) { return Fc + (Fs - Fc) * std::exp(-std::pow(std::abs(w) / vs, shape)); }

/// Integral of m/F(w) from `low` to `high`: the time in which a mass slows down, by Simpson's rule in the logarithm of speed.
double slowing(double m, double shape, double extra, double low, double high) {
  constexpr int n = 40000;
  const double a = std::log(low), h = (std::log(high) - a) / n;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double w = std::exp(a + k * h), y = m * w / (stribeck(w, shape) + extra);
    sum += y * (k == 0 || k == n ? 1 : k % 2 ? 4 : 2);
  }
  return sum * h / 3;
}

}  // namespace

TEST_CASE("stribeck: a mass slows down, stops, and sticks exactly") {
  const double m = 1.7, v0 = 0.41;
  for (const double shape : {2.0, 1.0, 1.6, 3.0}) {
    for (const double s : {1.0, -1.0}) {
      const std::string toml = netlist({{"m", m}, {"Fc", Fc}, {"Fs", Fs}, {"vs", vs}, {"n", shape}, {"v0", s * v0}}, R"(
[nodes]
x = { velocity = "v0" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
rub  = { type = "slider", between = ["x", "ground"], coulomb = "Fc", breakaway = "Fs", stribeck = "vs", shape = "n" }
)", 0.5) + "record = [\"x.velocity\", \"rub.force\", \"rub.dissipated\"]\n";
      const double least = 1e-5 * v0, rest = slowing(m, shape, 0, least, v0) + m * least / Fs;
      REQUIRE_LT(rest, 0.45);
      for (const double accuracy : accuracies) {
        CAPTURE(shape);
        CAPTURE(accuracy);
        const RunTable rows = simulate(toml, accuracy);
        for (std::size_t row = 0; row < rows.time().size(); ++row) {
          const double t = rows.time()[row], w = rows["x.velocity"][row], f = rows["rub.force"][row];
          if (t > rest + 10 * accuracy) {
            CHECK_EQ(w, 0);
            CHECK_LE(std::abs(f), 1e-12);
          } else if (std::abs(w) > 20 * accuracy * v0 && std::abs(w) > least) {
            CHECK_LE(std::abs(slowing(m, shape, 0, std::abs(w), v0) - t), 10 * accuracy * v0 * m / stribeck(w, shape) + 1e-9);
            CHECK_LE(std::abs(f - s * stribeck(w, shape)), 1e-6 * Fs);
            CHECK_LE(std::abs(rows["rub.dissipated"][row] - f * w), 1e-12);
          }
        }
      }
    }
  }
}

// It holds up to Fs and no further. Beyond it the force falls.
TEST_CASE("stribeck: both sides of breaking away, with a normal force too") {
  for (const double share : {1 - 1e-6, 1 + 1e-6}) {
    for (const bool normal : {false, true}) {
      const std::string friction = normal ? "normal = 100, coulomb = 0.023, breakaway = 0.037" : "coulomb = 2.3, peak = 1.608695652173913";
      const RunTable rows = simulate(netlist({{"F", share * Fs}}, fmt::format(R"(
[elements]
mass = {{ type = "mass", at = "x", mass = 1.7 }}
pull = {{ type = "force", at = "x", force = "F" }}
rub  = {{ type = "slider", between = ["x", "ground"], {}, stribeck = 0.031 }}
)", friction), 300), 1e-6);
      if (share < 1) {
        CHECK_EQ(rows["x.velocity"].back(), 0);
        CHECK_EQ(rows["rub.force"].back(), doctest::Approx(share * Fs));
      } else {
        CHECK_GT(rows["x.velocity"].back(), 10 * vs);
        CHECK_EQ(rows["rub.force"].back(), doctest::Approx(Fc));
      }
    }
  }
}

// A strong force turns a fast mass round: a step from far outside the curve must not pass over it.
TEST_CASE("stribeck: a fast mass feels the curve where it reverses, however narrow that is") {
  const double m = 1.3, v0 = 12, F = 50;
  for (const double shape : {2.0, 1.0}) {
    for (const double s : {1.0, -1.0}) {
      const double least = 1e-9, turn = slowing(m, shape, F, least, v0) + m * least / (F + Fs);
      const double plain = m * v0 / (F + Fc);
      REQUIRE_GT(plain - turn, 1e-5);
      const std::string toml = netlist({{"m", m}, {"Fc", Fc}, {"Fs", Fs}, {"vs", vs}, {"n", shape}, {"v0", s * v0}, {"F", -s * F}}, R"(
[nodes]
x = { velocity = "v0" }
[elements]
mass = { type = "mass", at = "x", mass = "m" }
push = { type = "force", at = "x", force = "F" }
rub  = { type = "slider", between = ["x", "ground"], coulomb = "Fc", breakaway = "Fs", stribeck = "vs", shape = "n" }
)", turn + 0.2);
      for (const double accuracy : accuracies) {
        // After the turn the same time passes up to the same speed, with the friction on the other side.
        const double v = std::abs(simulate(toml, accuracy)["x.velocity"].back());
        CHECK_LE(std::abs(slowing(m, shape, -F, least, v) + 0.2), 10 * accuracy * v0 * m / (F - Fc) + 1e-8);
      }
    }
  }
}

TEST_CASE("stribeck: mistakes and limits") {
  const auto with = [](const std::string& parameters, const std::string& more = "m = { type = \"mass\", at = \"x\", mass = 1 }") {
    return refusal("[elements]\n" + more + "\nrub = { type = \"slider\", between = [\"x\", \"ground\"], " + parameters + " }\n[simulate]\nstop = 1\n");
  };
  CHECK_EQ(with("coulomb = 1, breakaway = 2, stribeck = 0.1"), "");
  CHECK_EQ(with("coulomb = \"inf\", stribeck = 0.1"), "");
  CHECK(with("coulomb = 1, breakaway = 2, stribeck = 0").find("`stribeck`") != std::string::npos);
  CHECK(with("coulomb = 1, breakaway = 2, stribeck = 0.1, shape = 0.1").find("`shape`") != std::string::npos);
  CHECK(with("coulomb = { ramp = 1 }, breakaway = 2, stribeck = 0.1").find("constant `coulomb`") != std::string::npos);
  CHECK(with("coulomb = 1, breakaway = 2, stribeck = 0.1", "k = { type = \"spring\", between = [\"x\", \"y\"], stiffness = 1 }\n"
             "d = { type = \"motion\", at = \"y\", velocity = 1 }").find("node `x` has no mass") != std::string::npos);
}

}  // namespace rheonet::test::stribeck_test
