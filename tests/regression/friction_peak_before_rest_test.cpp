// Friction has a peak near rest (Stribeck). A mass that is reversed fast passes it within a fraction of a step of the integrator, and both ends of
// such a step are off the peak, or at rest.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::friction_peak_before_rest_test {

namespace {

constexpr double m = 0.8, s0 = 1e6, s1 = 150, s2 = 0.6, Fc = 1.3, Fs = 2, vs = 2e-3, F = 3.7, f = 0.9, stop = 1.5;

using State = std::array<double, 3>;  // x, v, z

/// LuGre's friction (C. Canudas de Wit et al. 1995) on a mass under a triangular force.
State rates(double t, const State& s) {
  const auto [x, v, z] = s;
  const double turns = f * t - std::floor(f * t), force = F * (turns < 0.25 ? 4 * turns : turns < 0.75 ? 2 - 4 * turns : 4 * turns - 4);
  const double g = Fc + (Fs - Fc) * std::exp(-(v / vs) * (v / vs)), dz = v - s0 * std::abs(v) * z / g;
  return {v, (force - s0 * z - s1 * dz - s2 * v) / m, dz};
}

}  // namespace

TEST_CASE("the peak of friction before rest counts, however short the time in which it is passed") {
  constexpr int per_row = 10'000, rows = 150;
  std::array<double, rows + 1> x{}, friction{};
  State s{0, 0, 3e-6};
  const auto store = [&](int row) {
    const State r = rates(stop * row / rows, s);
    x[static_cast<std::size_t>(row)] = s[0];
    friction[static_cast<std::size_t>(row)] = s0 * s[2] + s1 * r[2] + s2 * s[1];
  };
  store(0);
  for (int i = 0; i < rows * per_row; ++i) {
    const double h = stop / (rows * per_row), t = h * i;
    const auto ahead = [&s](double by, const State& rate) { return State{s[0] + by * rate[0], s[1] + by * rate[1], s[2] + by * rate[2]}; };
    const State a = rates(t, s), b = rates(t + h / 2, ahead(h / 2, a)), c = rates(t + h / 2, ahead(h / 2, b)), d = rates(t + h, ahead(h, c));
    for (std::size_t j = 0; j < s.size(); ++j) s[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    if ((i + 1) % per_row == 0) store((i + 1) / per_row);
  }
  for (const double accuracy : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    CAPTURE(accuracy);
    const RunTable run = simulate(fmt::format(R"toml([laws.lugre]
parameters = {{ s0 = "1e6 N/m", s1 = "150 N*s/m", s2 = "0.6 N*s/m", Fc = "1.3 N", Fs = "2 N", vs = "2 mm/s" }}
where = {{ g = "Fc + (Fs - Fc)*exp(-(w/vs)^2)" }}
states = {{ z = {{ start = "3 um", rate = "w - s0*abs(w)*z/g" }} }}
force = "s0*z + s1*rate(z) + s2*w"
[elements]
m  = {{ type = "mass", at = "x", mass = {} }}
F  = {{ type = "force", at = "x", force = {{ triangle = {}, frequency = {} }} }}
fr = {{ type = "lugre", between = ["x", "ground"] }}
[simulate]
stop = {}
output = {{ points = {} }}
)toml", m, F, f, stop, rows + 1), accuracy);
    double worst_x = 0, worst_friction = 0;
    for (std::size_t row = 0; row < x.size(); ++row) {
      worst_x = std::max(worst_x, std::abs(run["x.position"][row] - x[row]));
      worst_friction = std::max(worst_friction, std::abs(run["fr.force"][row] - friction[row]));
    }
    CHECK_LE(worst_x, accuracy * run.scale("x.position"));
    CHECK_LE(worst_friction, accuracy * run.scale("fr.force"));
  }
}

}  // namespace rheonet::test::friction_peak_before_rest_test
