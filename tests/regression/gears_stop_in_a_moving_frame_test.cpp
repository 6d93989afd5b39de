// Gears and brakes pass through rest relative to a base that moves. The last digits of the event left a velocity that does not fit the gears. It is small
// beside that of the base, and nodes were joined across it. The inertia of that jump outweighed all forces: "it cannot be decided what slips".
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::gears_stop_in_a_moving_frame_test {

namespace {

std::string seen_from(double v) {
  return fmt::format(R"([elements]
carrier = {{ type = "motion", at = "base", velocity = {0} }}
drive = {{ type = "motion", at = "end", velocity = {{ triangle = 1.6718553488636925, frequency = 3.091087456890205, offset = {0} }} }}
e1 = {{ type = "vfm", between = ["n3", "base"], stiffness = 8.109298580104753, damping = 0.5585253808087278 }}
e2 = {{ type = "slider", between = ["n3", "n4"], coulomb = 1.0535338936647929 }}
e3 = {{ type = "spring", between = ["base", "n1"], stiffness = 7.528901248853125 }}
e4 = {{ type = "cfm", between = ["n3", "n4"], stiffness = 7.709037034352844, damping = 1.1890255175423448, coulomb = 0.46098480649893436, exponent = 1 }}
e5 = {{ type = "gear", between = ["base", "n2"], ratio = -0.5775782426519647, support = "n3" }}
e6 = {{ type = "slider", between = ["end", "n4"], coulomb = 2.4440703647088204 }}
e7 = {{ type = "gear", between = ["n2", "end"], ratio = 0.4867208898314937, support = "n4" }}
e8 = {{ type = "dashpot", between = ["end", "n1"], damping = 3.775747005857535 }}
e9 = {{ type = "slider", between = ["n2", "base"], coulomb = 0.4392970390130274 }}
e10 = {{ type = "sfm", between = ["n3", "n1"], stiffness = 27.78610629102407, coulomb = 1.2313851586305364, exponent = 0 }}
m_n1 = {{ type = "mass", at = "n1", mass = 0.08475191792296892 }}
m_n2 = {{ type = "mass", at = "n2", mass = 0.014579553163397645 }}
m_n3 = {{ type = "mass", at = "n3", mass = 0.03808134062819963 }}
m_n4 = {{ type = "mass", at = "n4", mass = 0.01106229474883268 }}
[nodes]
n1 = {{ velocity = {0} }}
n2 = {{ velocity = {0} }}
n3 = {{ velocity = {0} }}
n4 = {{ velocity = {0} }}
[simulate]
stop = 0.6
output = {{ points = 61 }}
)",
                     v);
}

}  // namespace

TEST_CASE("gears and brakes that stop relative to a moving base reverse there as at rest") {
  constexpr double accuracy = 1e-6;
  const RunTable rest = simulate(seen_from(0), accuracy);
  for (const double v : {0.371, -0.371, 4.0}) {
    CAPTURE(v);
    const RunTable moving = simulate(seen_from(v), accuracy);
    for (const char* element : {"e1", "e2", "e4", "e5", "e6", "e7", "e8", "e9", "e10"}) {
      CAPTURE(element);
      const std::string force = std::string(element) + ".force";
      double off = 0;
      for (std::size_t i = 0; i < rest.time().size(); ++i) off = std::max(off, std::abs(moving[force][i] - rest[force][i]));
      CHECK(off <= 20 * accuracy * rest.scale(force));
    }
  }
}

}  // namespace rheonet::test::gears_stop_in_a_moving_frame_test
