#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/support/simulate.hpp"

namespace rheonet::test::position_from_slip_on_test {

// A node that a slider held at ground began to move. Its position was 0 until then, and its tolerance so small that the residual of the balance after
// the restart exceeded it at accuracies below 1e-6. No step was small enough.
TEST_CASE("the position of a node that a slider has held") {
  constexpr double coulomb = 0.43103110705498004, speed = 1.161525192610613;
  for (const double accuracy : {1e-5, 1.01e-6, 1e-6, 0.9e-6, 0.5e-6, 1e-7}) {
    CAPTURE(accuracy);
    const RunTable rows = simulate(fmt::format(R"([elements]
drive = {{ type = "motion", at = "end", velocity = -{:.17g} }}
e1 = {{ type = "slider", between = ["n1", "ground"], coulomb = {:.17g} }}
e2 = {{ type = "cfm", between = ["n1", "n2"], stiffness = 18.8903497949897, damping = 4.079801429516908, coulomb = 1.3355588946845398, exponent = 0 }}
e3 = {{ type = "cfm", between = ["n2", "end"], stiffness = 28.902146966431424, damping = 1.6355766061436963, coulomb = 0.4923176027429337, exponent = 0 }}
[simulate]
stop = 0.2
accuracy = {:.17g}
output = {{ points = 21 }}
)",
                                               speed, coulomb, accuracy));
    // Below their bounds, at a constant force, both flow by their dashpots alone.
    const double slips = speed - coulomb * (1 / 4.079801429516908 + 1 / 1.6355766061436963);
    CHECK(rows["n1.velocity"].back() == doctest::Approx(-slips));
    CHECK(rows["n1.position"].back() - rows["n1.position"][10] == doctest::Approx(-slips * 0.1));
    CHECK(rows["e1.force"].back() == -coulomb);
  }
}

}  // namespace rheonet::test::position_from_slip_on_test
