#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::late_start_test {

// A force that starts smoothly and late. The first scales are estimated from the motion in the first moments, which was so small that no step
// longer than the round-off of the time could resolve it.
TEST_CASE("a force that sets in late moves masses on a pseudoplastic dashpot as it would have at once") {
  constexpr double late = 0.272, stop = 1.6;
  const auto netlist = [&](double begin) {
    return fmt::format(
        "[elements]\nk = {{ type = \"spring\", between = [\"n0\", \"n2\"], stiffness = 164 }}\n"
        "c = {{ type = \"dashpot\", between = [\"n2\", \"ground\"], damping = 1.02, flow_index = 0.3 }}\n"
        "m2 = {{ type = \"mass\", at = \"n2\", mass = 0.275 }}\nm0 = {{ type = \"mass\", at = \"n0\", mass = 0.2 }}\n"
        "push = {{ type = \"force\", at = \"n0\", force = {{ sine = 0.603, frequency = 1.395, time = {} }} }}\n"
        "[simulate]\nstop = {}\noutput = {{ points = 2 }}\n",
        begin, stop + begin);
  };
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    const test::RunTable at_once = test::simulate(netlist(0), accuracy), then = test::simulate(netlist(late), accuracy);
    for (const char* record : {"n0.position", "n2.position", "k.force", "c.force", "n0.velocity"}) {
      CAPTURE(record);
      const double difference = std::abs(then[record].back() - at_once[record].back());
      CHECK(difference <= 2 * accuracy * at_once.scale(record) + 1e-13);
    }
  }
}

}  // namespace rheonet::test::late_start_test
