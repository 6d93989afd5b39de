#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/simulate.hpp"

namespace rheonet::test::small_displacement_test {

// The displacement of an assembly, or of a dashpot, was the difference of two positions also where a spring beside it knew it
// better: 2.7e-12 m behind a node that has moved by metres kept four digits.
TEST_CASE("a small displacement beside large ones has all its digits") {
  const RunTable rows = simulate(R"([elements]
pull = { type = "force", at = "end", force = 2.7 }
hand = { type = "motion", at = "far", position = { ramp = 3.1 } }
soft = { type = "spring", between = ["far", "near"], stiffness = 1 }
stiff = { type = "spring", between = ["near", "post"], stiffness = 1e12 }
post = { type = "motion", at = "post", position = 0.7 }
mirror = { type = "dashpot", between = ["post", "near"], damping = 1e-3 }
[elements.creep]
between = ["end", "ground"]
series = [
  { name = "stiff", parallel = [ { type = "dashpot", damping = 1.3 }, { type = "spring", stiffness = 1e12 } ] },
  { name = "soft", parallel = [ { type = "spring", stiffness = 1 }, { type = "dashpot", damping = 1.3 } ] },
]
[simulate]
stop = 4
accuracy = 1e-9
record = ["creep.stiff.displacement", "creep.stiff.dashpot1.displacement", "creep.soft.displacement", "mirror.displacement"]
)");
  for (const char* path : {"creep.stiff.displacement", "creep.stiff.dashpot1.displacement"}) {
    CHECK(rows[path].back() == doctest::Approx(2.7e-12).epsilon(1e-9));
  }
  CHECK(rows["creep.soft.displacement"].back() == doctest::Approx(2.7 * (1 - std::exp(-4 / 1.3))).epsilon(1e-9));
  CHECK(rows["mirror.displacement"].back() == doctest::Approx(-(12.4 - 0.7) * 1e-12).epsilon(1e-9));
}

}  // namespace rheonet::test::small_displacement_test
