#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::rest_at_its_bound_test {

namespace {

constexpr double k = 11.3, Fc = 0.83, coulomb = 0.41, B = 3.1, sigma = 520;

/// The force of the spring from the instant of rest on. The slider has its full force; the friction has the rest of the spring's
/// and slides on at the velocity w that this takes, or stands where that would be backwards.
class Spring {
 public:
  explicit Spring(double (*velocity)(double)) : velocity_(velocity) {}

  /// At t, to be asked in order of time.
  double operator()(double t) {
    constexpr double step = 1e-5;
    while (t_ < t) {
      const double h = std::min(step, t - t_);
      const double a = rate(t_, force_), b = rate(t_ + h / 2, force_ + h / 2 * a), c = rate(t_ + h / 2, force_ + h / 2 * b);
      force_ += h / 6 * (a + 2 * b + 2 * c + rate(t_ + h, force_ + h * c));
      t_ += h;
    }
    return force_;
  }

 private:
  double rate(double t, double force) const {
    const double f = force - Fc, slope = sigma * (1 - f / coulomb), v = velocity_(t);
    return k * (v - std::max(0.0, (k * v + slope * f / B) / (k + slope)));
  }

  double (*velocity_)(double);
  double t_ = 0, force_ = Fc + coulomb;
};

}  // namespace

// A node comes to rest smoothly while combined friction is at its bound, in parallel with a slider. The friction continued as if it slid, and
// left its bound at a time that depended on round-off. In fact it is at rest: it relaxes faster than the force of the spring falls, so that
// the slider stays at its full force, and the friction takes the rest of the spring's force.
TEST_CASE("combined friction that comes to rest at its bound beside a slider gives way") {
  struct Case { std::string velocity; double (*back)(double); };
  const Case cases[] = {{"{ sine = 1, frequency = 0.5 }", [](double t) { return -std::sin(std::numbers::pi * t); }},
                        {"{ ramp = -2, offset = 2 }", [](double t) { return -2 * t; }}};
  for (const Case& one : cases) {
    for (const int side : {1, -1}) {
      for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(one.velocity);
        CAPTURE(side);
        CAPTURE(accuracy);
        // Turned round, everything is the same but for its sign.
        const char* const from = side > 0 ? "n" : "ground";
        const char* const to = side > 0 ? "ground" : "n";
        const RunTable rows = simulate(fmt::format(R"([elements]
drive = {{ type = "motion", at = "a", velocity = {0} }}
spring = {{ type = "spring", stiffness = {1}, between = ["a", "n"] }}
slider = {{ type = "slider", between = ["{2}", "{3}"], coulomb = {4} }}
friction = {{ type = "cfm", between = ["{2}", "{3}"], coulomb = {5}, damping = {6}, stiffness = {7}, exponent = 1 }}
[simulate]
stop = 1.13
output = {{ points = 227 }}
record = ["slider.force", "friction.force", "spring.force"]
)",
                                                     one.velocity, k, from, to, Fc, coulomb, B, sigma),
                                         accuracy);
        Spring expected(one.back);
        const double allowed = accuracy * (Fc + coulomb) + 1e-9;
        int seen = 0;
        for (std::size_t i = 0; i < rows.time().size(); ++i) {
          if (rows.time()[i] < 0.9) continue;
          const double spring = expected(rows.time()[i] - 1);
          ++seen;
          CHECK(std::abs(rows["spring.force"][i] - spring) < allowed);
          CHECK(std::abs(side * rows["slider.force"][i] - Fc) < allowed);
          CHECK(std::abs(side * rows["friction.force"][i] - (spring - Fc)) < allowed);
        }
        CHECK(seen > 30);
      }
    }
  }
}

}  // namespace rheonet::test::rest_at_its_bound_test
