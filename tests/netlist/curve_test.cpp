// Monotone cubics through points: known values, and what they promise of any points.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/netlist/curve.hpp"
#include "core/netlist/signal.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::curve_test {

namespace {

/// Points at uneven times: so many that rise, or that go up and down.
Curve random_curve(std::mt19937& random, bool rising, std::vector<double>& times, std::vector<double>& values) {
  std::uniform_real_distribution<double> length(0.05, 2), step(-3, 3);
  times = {-0.7};
  values = {0.4};
  for (int i = 0; i < 12; ++i) {
    times.push_back(times.back() + length(random));
    values.push_back(values.back() + (rising ? std::abs(step(random)) : step(random)));
  }
  return Curve(times, values);
}

}  // namespace

TEST_CASE("rates of a monotone cubic are those of the cubic spline, unless they would overshoot") {
  // Slopes 1, 1/2, 3 over intervals of 1, 2, 1; rates 7/6 and 23/6 at the ends by three points. The inner rates solve
  // 2 r0 + 6 r1 + r2 = 3 (2 + 1/2) and r1 + 6 r2 + 2 r3 = 3 (1/2 + 6).
  const Curve curve({0, 1, 3, 4}, {0, 1, 2, 5});
  const double p = 7.5 - 7.0 / 3, q = 19.5 - 23.0 / 3;
  CHECK(curve.rates()[0] == doctest::Approx(7.0 / 6).epsilon(1e-15));
  CHECK(curve.rates()[1] == doctest::Approx((6 * p - q) / 35).epsilon(1e-14));
  CHECK((6 * q - p) / 35 > 1.5);  // that would overshoot
  CHECK(curve.rates()[2] == 1.5);
  CHECK(curve.rates()[3] == doctest::Approx(23.0 / 6).epsilon(1e-15));
  // An extremum stays one; an end whose three-point rate points the other way is flat, and one that is too steep is held back.
  CHECK(Curve({0, 1, 2}, {0, 1, 0.5}).rates()[1] == 0);
  CHECK(Curve({0, 1, 2}, {0, 0.1, 5}).rates()[0] == 0);
  CHECK(Curve({0, 1, 2}, {0, 1, -9}).rates()[0] == 3);
  CHECK(Curve({1, 3}, {2, 5}).rates() == std::vector<double>{1.5, 1.5});
  // A cubic whose points are monotone is found again, but for its ends.
  std::vector<double> times, values;
  for (int i = 0; i <= 40; ++i) {
    times.push_back(0.1 * i + 0.03 * std::sin(i));
    values.push_back(std::pow(times.back() + 1, 3));
  }
  const Curve cubic(times, values);
  for (std::size_t i = 15; i < 25; ++i) CHECK(cubic.rates()[i] == doctest::Approx(3 * std::pow(times[i] + 1, 2)).epsilon(1e-9));
}

TEST_CASE("a monotone cubic goes through its points, with its derivatives and its area, and overshoots none") {
  std::mt19937 random(11);
  std::vector<double> times, values;
  for (int round = 0; round < 60; ++round) {
    const Curve curve = random_curve(random, round % 2 == 0, times, values);
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      CHECK(curve.value(times[i]) == doctest::Approx(values[i]));
      const double low = std::min(values[i], values[i + 1]), high = std::max(values[i], values[i + 1]);
      const double h = times[i + 1] - times[i];
      // Continuous with its rate.
      CHECK(curve.value(times[i + 1] - 1e-9 * h) == doctest::Approx(values[i + 1]).epsilon(1e-7));
      CHECK(curve.rate(times[i + 1] - 1e-9 * h) == doctest::Approx(curve.rates()[i + 1]).epsilon(1e-6));
      for (const double share : {0.13, 0.41, 0.77}) {
        const double t = times[i] + share * h, d = 1e-4 * h;
        CHECK(curve.value(t) >= low - 1e-12);
        CHECK(curve.value(t) <= high + 1e-12);
        CHECK((curve.value(t + d) - curve.value(t - d)) / (2 * d) == doctest::Approx(curve.rate(t)).epsilon(1e-5));
        CHECK((curve.rate(t + d) - curve.rate(t - d)) / (2 * d) == doctest::Approx(curve.curvature(t)).epsilon(1e-5));
        CHECK((curve.area(t + d) - curve.area(t - d)) / (2 * d) == doctest::Approx(curve.value(t)).epsilon(1e-5));
        CHECK(std::abs(curve.value(t)) <= curve.largest());
        CHECK(std::abs(curve.rate(t)) <= curve.largest_rate() * (1 + 1e-12));
        CHECK(std::abs(curve.curvature(t)) <= curve.largest_curvature() * (1 + 1e-12));
        CHECK(std::abs(curve.curvature(t + d) - curve.curvature(t - d)) <= 2 * d * curve.largest_third() * (1 + 1e-6) + 1e-9);
      }
    }
    CHECK(curve.area(times.front()) == 0);
  }
}

TEST_CASE("a smooth table is one stretch from jump to jump, and held before and after") {
  const Signal signal(Signal::Table{{1, 2, 4, 4, 5, 6}, {0.2, 1.2, 0.7, 3, 4, 4.5}, 0.5, 10, true});
  CHECK(signal.piece(0.1).end == 0.5);
  CHECK(signal.value(0.1) == 10);
  CHECK(signal.value(1.2) == 10.2);
  CHECK(signal.piece(1.2).end == 1.5);
  CHECK(signal.piece(1.6).end == 4.5);
  CHECK(signal.piece(4.5).end == 6.5);
  CHECK(signal.value(4.5) == 13);
  CHECK(signal.before(4.5) == doctest::Approx(10.7));
  CHECK(signal.value(5.5) == doctest::Approx(14));
  CHECK(signal.value(9) == 14.5);
  // The points after a jump do not change the curve before it.
  const Curve alone({1.5, 2.5, 4.5}, {10.2, 11.2, 10.7});
  for (const double t : {1.7, 2.6, 4.4}) CHECK(signal.value(t) == doctest::Approx(alone.value(t)).epsilon(1e-14));
  // Seen from later it is the same.
  CHECK(signal.seen_from(1.25).value(2.6 - 1.25) == doctest::Approx(signal.value(2.6)).epsilon(1e-14));
  CHECK(signal.piece(1.6).integral(1.7, 4.1) == doctest::Approx(alone.area(4.1) - alone.area(1.7)).epsilon(1e-14));
}

}  // namespace rheonet::test::curve_test
