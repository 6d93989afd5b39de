#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::reversal_beside_drag_test {

// The force of a dilatant dashpot near rest tells hardly anything of its velocity. At a node without mass that leaves a large
// rounding of the velocity; a mass has its own, and friction there turns where it does: it turned 30 ns late, at the tightest
// accuracies only.
TEST_CASE("friction on a mass turns in time beside a drag that is felt at speed alone") {
  for (const double drag : {1e-6, 1e-2}) {
    CAPTURE(drag);
    const std::string scene = test::netlist({{"drag", drag}}, R"([elements]
drive = { type = "motion", at = "n0", velocity = { sine = 0.3083, frequency = 1.17 } }
k = { type = "spring", between = ["n1", "n0"], stiffness = 14.27 }
m = { type = "mass", at = "n1", mass = 1.449 }
f = { type = "cfm", between = ["n1", "ground"], stiffness = 58.92, coulomb = 0.1197, damping = 2.288, exponent = 1 }
air = { type = "dashpot", between = ["n1", "ground"], damping = "drag", flow_index = 2 }
)", 2, 41);
    const test::RunTable run = test::simulate(scene, 1e-9), closer = test::simulate(scene, 1e-11);
    for (const char* record : {"f.force", "n1.velocity", "k.force"}) {
      CAPTURE(record);
      double worst = 0;
      for (std::size_t k = 0; k < run.time().size(); ++k) worst = std::max(worst, std::abs(run[record][k] - closer[record][k]));
      CHECK(worst < 1e-9 * closer.scale(record));
    }
  }
}

}  // namespace rheonet::test::reversal_beside_drag_test
