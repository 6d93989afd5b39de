#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::force_beyond_friction_test {

// Forces a little above what a slider and an sfm take together: the hundredth that was missing was left to slopes that
// are there to decide among equals, and the refusal came from the equations, without the elements.
TEST_CASE("a force half a percent beyond what all friction takes is refused with its names, one below runs") {
  const double most = 0.73 + 0.57;
  for (const double share : {1.005, 0.995}) {
    for (const char* const force : {"{0}", "{{ step = {0}, time = 0.4 }}"}) {
      const std::string signal = fmt::format(fmt::runtime(force), share * most);
      CAPTURE(signal);
      const std::string refusal = rheonet::test::refusal(fmt::format(R"([elements]
push = {{ type = "force", at = "a", force = {} }}
e1 = {{ type = "slider", between = ["a", "ground"], coulomb = 0.73 }}
e2 = {{ type = "sfm", between = ["a", "ground"], stiffness = 41.0, coulomb = 0.57 }}
[simulate]
stop = 2
accuracy = 1e-6
)",
                                                                     signal));
      const std::string time = signal.starts_with("{") ? "0.4" : "0";
      CHECK(refusal == (share < 1
                            ? ""
                            : "at t = " + time +
                                  " s nothing resists the force at node `a`: `e1`, `e2` are at the "
                                  "largest force that they can take; give the node a mass or a dashpot, or apply less "
                                  "force"));
    }
  }
}

}  // namespace rheonet::test::force_beyond_friction_test
