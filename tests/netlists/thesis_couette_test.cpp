// The claims of the scenes of Couette flow in netlists/thesis, with the values of the viscometer. tests/analytic/couette_test.cpp tests the
// wiring against closed forms with generic values.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/scene_file.hpp"

namespace rheonet::test::thesis_couette_test {

namespace {

constexpr double pi = std::numbers::pi;

// The viscometer with drum III, in SI: see netlists/thesis/couette.toml.
constexpr double R = 0.01905, h = 0.00635, H = 0.1016, nu = 164e-6, rho = 880, rate = 150 * pi / 180;
constexpr double A = 2 * pi * (R + h) * H, mu = nu * rho, uw = R * rate;
constexpr double T1 = h * h / (pi * pi * nu), start = T1 / 2;

double sign(int n) { return n % 2 ? 1 : -1; }

/// Eq. 47 (after = 0) and Eq. 55 (after = -1): the velocity at y over that of the moving wall.
double profile(double after, double y, double t) {
  double sum = 0;
  for (int n = 1; n <= 60; ++n)
    sum += sign(n) * 2 / (n * pi) * std::sin(n * pi * y / h) * std::exp(-std::pow(n * pi / h, 2) * nu * t);
  return after * y / h + (1 - after) * sum;
}

/// Eqs. 52 and 54, and the same after a reversal: torque on the cup by the first `terms` terms; `last` weighs the last
/// one.
double torque(double after, double t, int terms = 60, double last = 1) {
  double sum = 0;
  for (int n = 1; n <= terms; ++n)
    sum += (n == terms ? last : 1) * sign(n) * std::exp(-std::pow(n * pi / h, 2) * nu * t);
  const double F = A * mu * uw / h * (after + 2 * (1 - after) * sum);
  return (R + h) * F;
}

}  // namespace

TEST_CASE("couette.toml") {
  const SceneFile file = run_file("thesis/couette.toml");
  const RunTable& rows = file.rows;
  CHECK(file.value("vfm1", "damping") / file.value("vfm1", "stiffness") == doctest::Approx(T1));
  CHECK(T1 == doctest::Approx(0.0249).epsilon(2e-3));  // the thesis: 0.025 s by its fit
  const double steady = A * mu * uw / h * (R + h);
  CHECK(-rows["hold1.force"].front() == doctest::Approx(steady).epsilon(1e-6));
  CHECK(rows["vfm1.force"].front() == doctest::Approx(steady).epsilon(1e-6));
  for (std::size_t row = 0; row < rows.time().size(); ++row) {
    const double t = rows.time()[row] - start, TD = T1 * std::log(2);
    if (std::abs(t - TD) < 1e-9 * T1 || std::abs(t) < 1e-9 * T1) continue;
    const double first_term = t < TD ? 1 : 2 * std::exp(-t / T1);  // of the steady torque
    CHECK(std::abs(rows["late1.force"][row] - steady * first_term) <= 1e-5 * steady);
    CHECK(std::abs(rows["late2.force"][row] - steady * (2 * first_term - 1)) <= 1e-5 * steady);
  }
  int compared = 0;
  for (const auto& [after, gap, hold] :
       {std::tuple{0.0, "stopped", "hold1.force"}, std::tuple{-1.0, "reversed", "hold2.force"}}) {
    CAPTURE(gap);
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      const double t = rows.time()[row] - start;
      if (t < 0.1 * T1) continue;
      CAPTURE(t);
      CHECK(std::abs(-rows[hold][row] - torque(after, t)) <= 1e-3 * steady);
      for (const auto& [node, y] : {std::pair{8, 0.8}, std::pair{16, 0.6}, std::pair{24, 0.4}, std::pair{32, 0.2}}) {
        const double w = rows[fmt::format("{}.layers.node{}.velocity", gap, node)][row];
        CHECK(std::abs(w - rate * profile(after, y * h, t)) <= 1e-3 * rate);
      }
      ++compared;
    }
  }
  CHECK(compared > 900);
}

TEST_CASE("couette-terms.toml") {
  for (const auto& [K, last] :
       {std::pair{1, 0.5}, std::pair{1, 1.0}, std::pair{2, 0.5}, std::pair{5, 0.5}, std::pair{8, 0.5}}) {
    CAPTURE(K);
    const SceneFile file = run_file("thesis/couette-terms.toml",
                                    {fmt::format("parameters.K={}", K), fmt::format("parameters.last={}", last)});
    const RunTable& rows = file.rows;
    const double scale = rows.scale("odd.force");
    double worst = 0;
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      const double exact = torque(0, std::max(0.0, rows.time()[row] - start), K, last);
      worst = std::max(worst, std::abs(-rows["hold.force"][row] - exact) / scale);
    }
    CHECK(worst <= 1e-5);
    const double steady = A * mu * uw / h * (R + h) * (last == 0.5 ? 1 : 2);
    CHECK(-rows["hold.force"].front() == doctest::Approx(steady).epsilon(1e-6));
  }
}

}  // namespace rheonet::test::thesis_couette_test
