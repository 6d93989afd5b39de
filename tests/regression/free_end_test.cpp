#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/support/check.hpp"

namespace rheonet::test::free_end_test {

// Nothing acts on the free end, so that the only force scale there was came of rounding: the run crawled after it.
TEST_CASE("the free end of friction goes along without a force") {
  for (const char* exponent : {"0", "0.5", "1", "2"}) {
    CAPTURE(exponent);
    constexpr double v = 0.23, frequency = 1.3;
    const auto position = [&](double t) {
      return v / (2 * M_PI * frequency) * (1 - std::cos(2 * M_PI * frequency * t));
    };
    test::check_at_all_accuracies(test::netlist({{"v", v}, {"fr", frequency}},
                                                R"([elements]
drive = { type = "motion", at = "a", velocity = { sine = "v", frequency = "fr" } }
q = { type = "cfm", between = ["a", "b"], stiffness = 3.1, damping = 8.3, coulomb = 0.6, exponent = )" +
                                                    std::string(exponent) + " }\n",
                                                1.7, 41),
                                  {{"b.position", position}, {"q.force", [](double) { return 0.0; }, 0.6}});
  }
}

}  // namespace rheonet::test::free_end_test
