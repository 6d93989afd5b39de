// Stick-slip for so long that an error of each slip, always of one sign, would add up to more than the accuracy.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "tests/support/check.hpp"

namespace rheonet::test::long_stick_slip_test {

namespace {

/// A mass on friction, pulled by a spring whose end moves at v. See stick_slip_test.cpp: every slip is the same swing, so that
/// the time since the last break-away follows from the number of whole periods. In long double, as 1e6 s are 1e6 periods.
class Slips {
 public:
  static constexpr long double m = 1, k = 10, v = 0.1, Fc = 1, Fs = 1.5;

  long double stretch(long double t) const {
    const long double u = since_slip(t);
    if (u < 0) return v * t;
    if (u < slip_) return Fc / k + depth_ * std::cos(omega_ * u) + v / omega_ * std::sin(omega_ * u);
    return (2 * Fc - Fs) / k + v * (u - slip_);
  }
  long double velocity(long double t) const {
    const long double u = since_slip(t);
    if (u < 0 || u >= slip_) return 0;
    return v + omega_ * depth_ * std::sin(omega_ * u) - v * std::cos(omega_ * u);
  }

 private:
  long double since_slip(long double t) const {
    const long double u = t - Fs / (k * v);
    return u < 0 ? u : std::fmod(u, slip_ + 2 * depth_ / v);
  }

  long double omega_ = std::sqrt(k / m), depth_ = (Fs - Fc) / k;
  long double slip_ = 2 * (std::acos(-1.0L) - std::atan2(depth_ * omega_, v)) / omega_;
};

std::string pulled(double stop) {
  return fmt::format(R"(
[elements]
hand   = {{ type = "motion", at = "hand_end", velocity = 0.1 }}
spring = {{ type = "spring", between = ["hand_end", "block"], stiffness = 10 }}
mass   = {{ type = "mass", at = "block", mass = 1 }}
slider = {{ type = "slider", between = ["block", "ground"], coulomb = 1, breakaway = 1.5 }}
[simulate]
stop   = {}
output = {{ points = 1001 }}
record = ["block.velocity", "spring.force"]
)", stop);
}

}  // namespace

// RHEONET_LONG_RUN=30000 rheonet_tests -tc='*thousands of slips*' goes on for so many seconds, at the accuracies that double precision
// reaches there.
TEST_CASE("Stick-slip: after thousands of slips each is at its time") {
  const char* asked = std::getenv("RHEONET_LONG_RUN");
  const Slips exact;
  const Expectations expected = {{"block.velocity", [&](double t) { return static_cast<double>(exact.velocity(t)); }},
                                 {"spring.force", [&](double t) { return static_cast<double>(exact.k * exact.stretch(t)); }}};
  check_at_all_accuracies(pulled(700), expected);
  const std::string text = pulled(asked ? std::atof(asked) : 3000);
  for (const double accuracy : {1e-3, 1e-6}) {
    const RunTable rows = simulate(text, accuracy);
    for (const Expectation& e : expected) check_against(rows, e, accuracy);
  }
}

}  // namespace rheonet::test::long_stick_slip_test
