// Stops and stiff springs made of signal blocks, at places that are not 0: what the rounding of a place makes of a force is no
// motion that steps must follow.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <tuple>

#include "tests/support/check.hpp"

namespace rheonet::test::stops_of_blocks_test {

namespace {

using std::numbers::pi;

/// A mass comes at speed v from the side of larger x to a stop of stiffness k, which begins at `place`.
struct Stop {
  double m, k, v, place, away, stop;
  double omega() const { return std::sqrt(k / m); }
  double met() const { return away / v; }
  double left() const { return met() + pi / omega(); }
  double position(double t) const {
    if (t < met()) return place + v * (met() - t);
    return t < left() ? place - v / omega() * std::sin(omega() * (t - met())) : place + v * (t - left());
  }
  double velocity(double t) const {
    if (t < met()) return -v;
    return t < left() ? -v * std::cos(omega() * (t - met())) : v;
  }
};

std::string scene(const Stop& s) {
  return fmt::format(R"(
[elements]
m1     = {{ type = "mass", at = "a", mass = {:.17g} }}
rest   = {{ type = "generator", signal = {:.17g} }}
depth  = {{ type = "sum", in = ["rest", "-a.position"] }}
closed = {{ type = "limiter", in = "depth", lower = 0, upper = "inf" }}
F      = {{ type = "gain", in = "closed", gain = {:.17g} }}
wall   = {{ type = "force", at = "a", force = {{ block = "F" }} }}
[nodes]
a = {{ position = {:.17g}, velocity = {:.17g} }}
[simulate]
stop   = {:.17g}
output = {{ points = 1001 }}
record = ["a.position", "a.velocity", "wall.force"]
)", s.m, s.place, s.k, s.place + s.away, -s.v, s.stop);
}

}  // namespace

TEST_CASE("A stop made of blocks: contact for half a swing") {
  for (const double k : {10.0, 1e3, 1e6, 1e9}) {
    for (const double place : {0.0, 1e-3, 0.5, 1e3}) {
      Stop s{.m = 1.3, .k = k, .v = 1.1, .place = place, .away = 0.7, .stop = 0};
      s.stop = 2 * s.met() + pi / s.omega();
      CAPTURE(k);
      CAPTURE(place);
      // The place of the mass is known to its last digit, and what that is of the depth is known of the force.
      const double rounding = 1e3 * 2.3e-16 * place * s.omega() / s.v;
      for (const double accuracy : accuracies) {
        if (rounding > accuracy) continue;
        const RunTable rows = simulate(scene(s), accuracy);
        check_against(rows, {"a.position", [&](double t) { return s.position(t); }}, accuracy);
        check_against(rows, {"wall.force", [&](double t) { return std::max(0.0, s.k * (place - s.position(t))); }, s.v * std::sqrt(s.k * s.m)}, accuracy);
        // Skip rows next to the contact, in which the velocity reverses almost at once.
        const double guard = accuracy * s.stop;
        for (std::size_t i = 0; i < rows.time().size(); ++i) {
          const double t = rows.time()[i];
          if (t > s.met() - guard && t < s.left() + guard) continue;
          CHECK(std::abs(rows["a.velocity"][i] - s.velocity(t)) <= 10 * accuracy * s.v);
        }
      }
    }
  }
}

TEST_CASE("Two stops made of blocks: a mass goes to and fro between them") {
  constexpr double m = 0.7, k = 2e4, gap = 0.3, v = 1.7, low = 2, high = low + gap;
  const double contact = pi * std::sqrt(m / k), half = gap / v + contact, amplitude = v * std::sqrt(m / k);
  const std::string text = fmt::format(R"(
[elements]
m1    = {{ type = "mass", at = "a", mass = {0:.17g} }}
left  = {{ type = "generator", signal = {2:.17g} }}
right = {{ type = "generator", signal = {3:.17g} }}
below = {{ type = "sum", in = ["left", "-a.position"] }}
above = {{ type = "sum", in = ["a.position", "-right"] }}
push  = {{ type = "limiter", in = "below", lower = 0, upper = "inf" }}
pull  = {{ type = "limiter", in = "above", lower = 0, upper = "inf" }}
both  = {{ type = "sum", in = ["push", "-pull"] }}
F     = {{ type = "gain", in = "both", gain = {1:.17g} }}
walls = {{ type = "force", at = "a", force = {{ block = "F" }} }}
[nodes]
a = {{ position = {5:.17g}, velocity = {4:.17g} }}
[simulate]
stop   = 5
output = {{ points = 2001 }}
record = ["a.position"]
)", m, k, low, high, v, low + gap / 2);
  const auto position = [=](double t) {
    const double since_low = t + gap / (2 * v), n = std::floor(since_low / half), u = since_low - n * half;
    const double way = u < gap / v ? v * u : gap + amplitude * std::sin((u - gap / v) / std::sqrt(m / k));
    return std::fmod(n, 2) == 0 ? low + way : high - way;
  };
  check_at_all_accuracies(text, {{"a.position", position}});
}

// m x'' + c x' = k (place - x) + f(t), where all that is fast has long been damped.
TEST_CASE("A stiff spring made of blocks between places that are not 0") {
  constexpr double m = 0.15, c = 2500, force = 150, omega = 2 * pi;
  for (const double k : {1e5, 1e6}) {
    for (const double place : {0.0, -0.08025, 1.0}) {
      CAPTURE(k);
      CAPTURE(place);
      const std::string text = fmt::format(R"(
[elements]
m1   = {{ type = "mass", at = "a", mass = {0:.17g} }}
c1   = {{ type = "dashpot", between = ["a", "ground"], damping = {1:.17g} }}
f1   = {{ type = "force", at = "a", force = {{ sine = {2:.17g}, frequency = 1 }} }}
rest = {{ type = "generator", signal = {3:.17g} }}
d    = {{ type = "sum", in = ["rest", "-a.position"] }}
F    = {{ type = "gain", in = "d", gain = {4:.17g} }}
k1   = {{ type = "force", at = "a", force = {{ block = "F" }} }}
[nodes]
a = {{ position = {3:.17g} }}
[simulate]
stop   = 2
output = {{ points = 401 }}
record = ["a.velocity", "k1.force"]
)", m, c, force, place, k);
      // x = place + Im(X e^(i w t)) once the start has been damped, which takes some c/k + m/c.
      const std::complex<double> s(0, omega), X = force / (m * s * s + c * s + k);
      const double settled = 40 * (c / k + m / c);
      const auto velocity = [=](double t) { return (X * s * std::exp(s * t)).imag(); };
      const auto spring = [=](double t) { return -k * (X * std::exp(s * t)).imag(); };
      for (const double accuracy : accuracies) {
        const RunTable rows = simulate(text, accuracy);
        for (const auto& [name, exact, scale] : {std::tuple{"a.velocity", Exact(velocity), std::abs(X * s)}, std::tuple{"k1.force", Exact(spring), k * std::abs(X)}}) {
          double worst = 0;
          for (std::size_t i = 0; i < rows.time().size(); ++i) {
            if (rows.time()[i] > settled) worst = std::max(worst, std::abs(rows[name][i] - exact(rows.time()[i])));
          }
          CAPTURE(name);
          CAPTURE(accuracy);
          // The round-off of the mass's position is a force, too.
          CHECK(worst <= std::max(10 * accuracy, 1e2 * 2.3e-16 * std::abs(place) * k / force) * scale);
        }
      }
    }
  }
}

}  // namespace rheonet::test::stops_of_blocks_test
