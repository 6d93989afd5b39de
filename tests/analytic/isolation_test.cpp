// A mass that hardly moves beside what shakes it: its position is as exact, for its own size, as everything else.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::isolation_test {

TEST_CASE("isolation: the position of a mass on a soft spring under a base that shakes") {
  const double m = 0.0115, c = 2.6, X = 0.07, w = 2 * std::numbers::pi * 2.5;
  for (const double k : {1.0, 0.01, 1e-4}) {
    // From rest: m x'' + c x' + k x = k X sin(w t).
    const std::complex<double> i(0, 1), forced = k * X / (k - m * w * w + i * w * c);
    const double root = std::sqrt(c * c / 4 - m * k), fast = -(c / 2 + root) / m, slow = k / m / fast;
    const double x0 = -forced.imag(), v0 = -w * forced.real();  // what the free motion has to make up for
    const double a = (v0 - slow * x0) / (fast - slow), b = x0 - a;
    const auto x = [&](double t) { return forced.imag() * std::cos(w * t) + forced.real() * std::sin(w * t) + a * std::exp(fast * t) + b * std::exp(slow * t); };
    for (const double accuracy : {1e-4, 1e-6, 1e-8}) {
      const RunTable rows = simulate(fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "base", position = {{ sine = {}, frequency = 2.5 }} }}
k = {{ type = "spring", between = ["base", "body"], stiffness = {} }}
c = {{ type = "dashpot", between = ["body", "ground"], damping = {} }}
m = {{ type = "mass", at = "body", mass = {} }}
[simulate]
stop = 0.954
output = {{ points = 61 }}
record = ["body.position"]
)", X, k, c, m), accuracy);
      CAPTURE(k);
      CAPTURE(accuracy);
      CHECK(error_of(rows, "body.position", x) < accuracy);
    }
  }
}

}  // namespace rheonet::test::isolation_test
