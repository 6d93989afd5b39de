#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::nearly_equal_sliders_test {

namespace {

/// Two sliders in series, moved at 0.6 m/s; the first is stronger by `more` of its force. The velocity between them.
double velocity_between(double more, const std::string& force = "1.3") {
  const RunTable rows = simulate(fmt::format(R"([parameters]
Fc = "{} N"
more = {:.17g}
[elements]
drive = {{ type = "motion", at = "hand", velocity = 0.6 }}
first = {{ type = "slider", between = ["hand", "mid"], coulomb = "Fc + Fc*more" }}
second = {{ type = "slider", between = ["mid", "ground"], coulomb = "Fc" }}
[simulate]
stop = 1
)",
                                               force, more));
  return rows["mid.velocity"].back();
}

}  // namespace

// The regularisation that decides between equal sliders outweighed their difference. And the error of a balance was compared with the net
// force in place of the forces in it, so that sliders that differ in the last digit were reported as an overload.
TEST_CASE("sliders in series that differ by little") {
  for (const double more : {1e-3, 1e-6, 1e-9, 1e-10}) {
    CAPTURE(more);
    CHECK(velocity_between(more) == 0.6);
    CHECK(velocity_between(-more) == 0);
    CHECK(velocity_between(more, "3.7e-8") == 0.6);
  }
  // As equal: they share alike.
  for (const double more : {0.0, 2e-16, 1e-14, -1e-14}) {
    CAPTURE(more);
    CHECK(velocity_between(more) == doctest::Approx(0.3));
    CHECK(velocity_between(more, "3.7e8") == doctest::Approx(0.3));
  }
}

}  // namespace rheonet::test::nearly_equal_sliders_test
