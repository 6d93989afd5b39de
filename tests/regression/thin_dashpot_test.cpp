// A step of force moves a thin dashpot fast for a moment. The round-off of that velocity does not add up for the rest of the run.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::thin_dashpot_test {

TEST_CASE("two Kelvin-Voigt elements in series creep each by itself, however thin one dashpot is") {
  constexpr double F = 1.3, k = 2, c = 2e3;
  for (const double thin : {1e-1, 1e-5, 1e-9, 1e-13}) {
    CAPTURE(thin);
    for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
      CAPTURE(accuracy);
      const RunTable run = simulate(fmt::format(R"([elements]
k0 = {{ type = "spring", between = ["n0", "n1"], stiffness = 1 }}
c0 = {{ type = "dashpot", between = ["n0", "n1"], damping = {} }}
k1 = {{ type = "spring", between = ["n1", "ground"], stiffness = {} }}
c1 = {{ type = "dashpot", between = ["n1", "ground"], damping = {} }}
f = {{ type = "force", at = "n0", force = {} }}
[simulate]
stop = 5000
output = {{ points = 51 }}
)", thin, k, c, F), accuracy);
      double worst = 0;
      for (std::size_t row = 0; row < run.time().size(); ++row) {
        worst = std::max(worst, std::abs(run["k1.force"][row] - F * (1 - std::exp(-k / c * run.time()[row]))));
      }
      CHECK(worst <= 2 * accuracy * F);
    }
  }
}

}  // namespace rheonet::test::thin_dashpot_test
