#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/check.hpp"

namespace rheonet::test::dilatant_in_series_test {

namespace {

/// The velocity of the node between a dashpot B and one of B2 and n, when the other end of the first moves at v.
double shared(double v, double B, double B2, double n) {
  double low = 0, high = std::abs(v);
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (B2 * std::pow(middle, n) < B * (std::abs(v) - middle) ? low : high) = middle;
  }
  return std::copysign(low, v);
}

}  // namespace

// At close accuracies the iteration waited for changes below the rounding of the velocities, which never came: "changes
// faster than double precision can follow".
TEST_CASE("a dashpot and a dilatant one in series, driven at close accuracies") {
  constexpr double n = 1.75;
  const auto check = [n](const std::string& drive, double B, double B2, const std::string& beside,
                        const test::Exact& velocity) {
    const std::string toml = fmt::format(R"([elements]
drive = {{ type = "motion", at = "end", {} }}
e1 = {}
e2 = {{ type = "dashpot", between = ["n1", "end"], damping = {} }}
e3 = {{ type = "dashpot", between = ["ground", "n1"], damping = {}, flow_index = {} }}
[simulate]
stop = 1.0623
output = {{ points = 62 }}
)",
                                         drive, beside, B, B2, n);
    const test::Exact between = [&](double t) { return shared(velocity(t), B, B2, n); };
    const test::Exact force = [&](double t) { return B * (between(t) - velocity(t)); };
    for (const double accuracy : {1e-9, 1e-10}) {
      const test::RunTable run = test::simulate(toml, accuracy);
      test::check_against(run, {"n1.velocity", between}, accuracy);
      test::check_against(run, {"e2.force", force}, accuracy);
    }
  };
  const auto sides = [](double v, double frequency, double phase) {
    return [=](double t) { return std::fmod(t * frequency + phase, 1.0) < 0.5 ? v : -v; };
  };
  constexpr double v = -1.2251904439750647, f = 1.5568880258472528, d = 0.06011810406480225, g = 1.6461949457401481;
  check(fmt::format("velocity = {{ square = {}, frequency = {} }}", v, f), 2.7725361351434037, 0.8341091101672643,
        R"({ type = "spring", between = ["end", "ground"], stiffness = 40.739 })", sides(v, f, 0));
  check(fmt::format("position = {{ triangle = {}, frequency = {} }}", d, g), 1.3887363901426468, 1.676770975635443,
        R"({ type = "slider", between = ["ground", "end"], coulomb = 1.4797 })", sides(4 * d * g, g, 0.25));
}

// When a force has just reached the bound of a slider, the small remaining force moves the node of a dilatant dashpot with a velocity that is
// a root of it. The tolerances used the round-off at rest in place of the present one, so that the position had an error of 1e-6 or more.
TEST_CASE("the position of a node behind a dilatant dashpot, beside a slider, is as close as it is asked for") {
  constexpr double F = 0.95207, frequency = 2.674, B1 = 4.2135, B2 = 1.8991, Fc = 0.93825;
  constexpr double omega = 2 * std::numbers::pi * frequency;
  const double half = std::acos(Fc / F);  // of the angle in which it slips, about each extreme of the force
  // -F cos(a) pulls at the slider and, beyond Fc, at both dashpots: B2 v^2 = F abs(cos a) - Fc. With a = half sin(u)
  // from an extreme on the integral of v is smooth: Simpson's rule.
  const auto travelled = [&](double a) {
    constexpr int steps = 400;
    const double end = std::asin(a / half);
    double sum = 0;
    for (int k = 0; k <= steps; ++k) {
      const double u = end * k / steps, excess = F * std::cos(half * std::sin(u)) - Fc;
      const double weight = k == 0 || k == steps ? 1 : k % 2 ? 4 : 2;
      sum += weight * std::sqrt(std::max(0.0, excess) / B2) * half * std::cos(u);
    }
    return sum * end / (3 * steps) / omega;
  };
  // Extremes come at whole turns of half the angle, negative ones first; the run begins amid the first one.
  const test::Exact position = [&](double t) {
    const auto since = [&](int k) { return travelled(std::clamp(omega * t - k * std::numbers::pi, -half, half)); };
    double x = -since(0);
    for (int k = 1; k * std::numbers::pi - half < omega * t; ++k) x += (k % 2 ? 1 : -1) * (since(k) + travelled(half));
    return x;
  };
  const test::Exact velocity = [&](double t) {
    const double force = -F * std::cos(omega * t);
    return std::copysign(std::sqrt(std::max(0.0, std::abs(force) - Fc) / B2), force);
  };
  const std::string toml = test::netlist({{"F", F}, {"f", frequency}, {"B1", B1}, {"B2", B2}, {"Fc", Fc}}, R"([elements]
drive = { type = "force", at = "end", force = { cosine = "-F", frequency = "f" } }
e1 = { type = "dashpot", between = ["end", "n1"], damping = "B1" }
e2 = { type = "dashpot", between = ["n1", "ground"], damping = "B2", flow_index = 2 }
e3 = { type = "slider", between = ["end", "ground"], coulomb = "Fc" }
)",
                                         1.0353, 61);
  // At tighter accuracies the round-off where the dashpots come to rest would show: 8e-12 m.
  for (const double accuracy : {1e-3, 1e-6, 1e-8}) {
    const test::RunTable run = test::simulate(toml, accuracy);
    test::check_against(run, {"n1.position", position}, accuracy);
    test::check_against(run, {"n1.velocity", velocity, std::sqrt((F - Fc) / B2)}, accuracy);
  }
}

}  // namespace rheonet::test::dilatant_in_series_test
