#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::stiff_dashpots_in_series_test {

// The force of a dashpot far stiffer than its neighbour was taken from the difference of two velocities that agree in all but
// the last digits.
TEST_CASE("stiff dashpots in series with a soft one carry the same force") {
  for (const double stiff : {1.0, 900.0, 1100.0, 1e6, 1e9, 1e12}) {
    CAPTURE(stiff);
    constexpr double V = 0.7, c = 1.1, accuracy = 1e-9;
    const RunTable rows = simulate(fmt::format(R"([elements]
drive = {{ type = "motion", at = "hand", velocity = {{ sine = {}, frequency = 0.6 }} }}
first = {{ type = "dashpot", between = ["hand", "a"], damping = {} }}
soft = {{ type = "dashpot", between = ["a", "b"], damping = {} }}
last = {{ type = "dashpot", between = ["b", "c"], damping = {} }}
k = {{ type = "spring", between = ["c", "ground"], stiffness = 3 }}
[simulate]
stop = 1.3
output = {{ points = 53 }}
)",
                                                 V, stiff * c, c, stiff * c),
                                     accuracy);
    const double scale = rows.scale("soft.force");
    CHECK(scale > 0.2);
    for (std::size_t row = 0; row < rows.time().size(); ++row) {
      for (const char* path : {"first", "last"}) {
        CHECK(std::abs(rows[path + std::string(".force")][row] - rows["soft.force"][row]) <= 2 * accuracy * scale);
        CHECK(std::abs(rows[path + std::string(".velocity")][row] * stiff * c - rows["soft.force"][row]) <= 2 * accuracy * scale);
      }
    }
  }
}

}  // namespace rheonet::test::stiff_dashpots_in_series_test
