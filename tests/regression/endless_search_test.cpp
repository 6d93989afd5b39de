#include <doctest/doctest.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::endless_search_test {

// The margin of an event was the least number there is: the integrator's search for its instant divided by what underflowed,
// went to t = inf, and stayed there.
TEST_CASE("a friction that turns beside a pseudoplastic dashpot, to the last digit of the time: the search ends") {
  Summary summary;
  (void)test::simulate(test::scene_of(R"([elements]
drive = { type = "force", at = "end", force = { sine = -0.6049567013992847, frequency = 3.0137856367827194 } }
e1 = { type = "dashpot", between = ["n2", "n1"], damping = 1.7682085413742283, flow_index = 1.4 }
e2 = { type = "sfm", between = ["n3", "n1"], stiffness = 42.05735470087599, coulomb = 0.5222638234174045, exponent = 1.5 }
e3 = { type = "sfm", between = ["n3", "end"], stiffness = 14.676915645080575, coulomb = 0.7743548280506707, exponent = 0.5 }
e4 = { type = "slider", between = ["end", "n3"], coulomb = 0.8661834025878775 }
e5 = { type = "dashpot", between = ["n1", "end"], damping = 0.5360530513584816 }
e6 = { type = "sfm", between = ["n1", "ground"], stiffness = 47.6882377021832, coulomb = 0.4317241716440411, exponent = 1 }
e7 = { type = "spring", between = ["ground", "n3"], stiffness = 11.720359574494488 }
e8 = { type = "dashpot", between = ["n1", "n3"], damping = 2.323024229463803, flow_index = 0.5 }
e9 = { type = "dashpot", between = ["end", "n2"], damping = 1.9446934152723436 }
m_n1 = { type = "mass", at = "n1", mass = 0.012158055302826378 }
m_n2 = { type = "mass", at = "n2", mass = 0.0836474066354851 }
m_n3 = { type = "mass", at = "n3", mass = 0.051832964318128026 }
[simulate]
stop = 0.8106426870647363
)"), &summary);
  CHECK(summary.steps < 20000);
}

}  // namespace rheonet::test::endless_search_test
