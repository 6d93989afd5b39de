// The first event of a step, found in functions of time.
#include "core/solve/event_finder.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <vector>

namespace rheonet::test::event_finder_test {

namespace {

class OneFunction : public EventFunctions {
 public:
  int count() const override { return 1; }
  void evaluate(double, const double*, const double*, double*) override {}
};

/// The event of a step from 0 to 1 in which the function goes along a line.
std::optional<double> event(double at_begin, double at_end, bool long_step) {
  OneFunction one;
  EventFinder finder(one, true, [&](double t, std::vector<double>& functions) { functions.assign(1, at_begin + t * (at_end - at_begin)); });
  finder.at_begin().assign(1, at_begin);
  finder.arm();
  return long_step ? finder.in_long_step(0, 1) : finder.in_step(0, 1);
}

}  // namespace

TEST_CASE("a function that round-off has put at or below 0 at the beginning fires as it falls, and not as it rises") {
  for (const bool long_step : {false, true}) {
    CAPTURE(long_step);
    for (const double at_begin : {1e-30, 0.0, -1e-17}) {
      CAPTURE(at_begin);
      const std::optional<double> fallen = event(at_begin, -1, long_step);
      REQUIRE(fallen);
      CHECK(*fallen <= 1e-13);
      CHECK_FALSE(event(at_begin, 1, long_step));
    }
    CHECK_FALSE(event(0, 0, long_step));
    const std::optional<double> halfway = event(1, -1, long_step);
    REQUIRE(halfway);
    CHECK(*halfway == doctest::Approx(0.5).epsilon(1e-14));
  }
}

}  // namespace rheonet::test::event_finder_test
