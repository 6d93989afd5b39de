#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::from_turn_to_turn_test {

// Steps that lead from one reversal of a motion to the next saw no velocity but the round-off at the reversals, and compared that of a
// slider with it. Runs that ended within a certain time after a reversal were refused.
TEST_CASE("friction that only a motion moves, in runs of any length") {
  constexpr double frequency = 2.1704587531117108, coulomb = 0.48883785281205727;
  for (const double stop : {0.3, 0.47, 0.48150606287922605, 0.5, 0.7, 0.95}) {
    CAPTURE(stop);
    const RunTable rows = simulate(fmt::format(R"([elements]
drive = {{ type = "motion", at = "end", velocity = {{ sine = 0.8806682628570774, frequency = {:.17g} }} }}
e1 = {{ type = "slider", between = ["end", "ground"], coulomb = {:.17g}, breakaway = 0.7794639671377269 }}
e2 = {{ type = "cfm", between = ["ground", "end"], stiffness = 15.645243469976462, damping = 0.5116186644451364, coulomb = 0.5320349863944858, exponent = 1 }}
e3 = {{ type = "sfm", between = ["end", "ground"], stiffness = 8.85789924959379, coulomb = 0.6231488653732592, exponent = 0.5 }}
[simulate]
stop = {:.17g}
accuracy = 1e-6
output = {{ points = 31 }}
)",
                                               frequency, coulomb, stop));
    REQUIRE(rows.time().size() == 31);
    for (std::size_t i = 1; i < rows.time().size(); ++i) {
      const double phase = std::fmod(rows.time()[i] * frequency, 1.0);
      if (std::abs(phase - 0.5) < 1e-3 || phase < 1e-3 || phase > 1 - 1e-3) continue;  // near a reversal
      CHECK(rows["e1.force"][i] == (phase < 0.5 ? coulomb : -coulomb));
    }
  }
}

}  // namespace rheonet::test::from_turn_to_turn_test
