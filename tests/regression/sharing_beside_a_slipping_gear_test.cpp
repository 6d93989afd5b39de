// A slider locks one gear, and another gear with losses moves beside it: the load that the slider and the locked gear share has the losses.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::sharing_beside_a_slipping_gear_test {

// The slider holds `end` and `n3` together, so that the first gear takes `n4` along with them. The second gear then turns its mass by
// 1 - i of their velocity, against its losses. The run was refused: the forces were shared as if there were none.
TEST_CASE("a slider and the gear that it locks carry the losses of a gear beside them") {
  const double m4 = 0.051, m2 = 0.0135, ratio = 0.846, driving = 0.937;
  for (const char* method : {"exact", "ida"}) {
    for (const double force : {1.3, -0.7}) {
      CAPTURE(method);
      CAPTURE(force);
      const RunTable rows = simulate(fmt::format(R"(
[elements]
push = {{ type = "force", at = "end", force = {} }}
grip = {{ type = "slider", between = ["end", "n3"], coulomb = 2.3 }}
locked = {{ type = "gear", between = ["n4", "n3"], ratio = 0.584, support = "end", efficiency = [0.735, 0.675] }}
moves = {{ type = "gear", between = ["n2", "ground"], ratio = {}, support = "n3", efficiency = [{}, 0.765] }}
m2 = {{ type = "mass", at = "n2", mass = {} }}
m4 = {{ type = "mass", at = "n4", mass = {} }}
[simulate]
stop = 1
method = "{}"
output = {{ points = 11 }}
record = ["end.velocity", "n4.velocity", "n2.velocity", "moves.force"]
)",
                                                 force, ratio, driving, m2, m4, method));
      // The first node of the second gear drives: its mass is slower than the support.
      const double acceleration = force / (m4 + m2 * (1 - ratio) * (1 - ratio * driving));
      for (std::size_t row = 1; row < rows.time().size(); ++row) {
        const double v = acceleration * rows.time()[row];
        CHECK_EQ(rows["end.velocity"][row], doctest::Approx(v).epsilon(1e-7));
        CHECK_EQ(rows["n4.velocity"][row], doctest::Approx(v).epsilon(1e-7));
        CHECK_EQ(rows["n2.velocity"][row], doctest::Approx((1 - ratio) * v).epsilon(1e-7));
        CHECK_EQ(rows["moves.force"][row], doctest::Approx(-m2 * (1 - ratio) * acceleration).epsilon(1e-7));
      }
    }
  }
}

}  // namespace rheonet::test::sharing_beside_a_slipping_gear_test
