// Two inertias joined by a gear are one: with a thin dashpot, from rest, too. The gear was taken for friction that changes its mode, so that nothing
// seemed to be forgotten of the first steps, which asked for more accuracy than double precision has.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test::geared_inertias_are_one_test {

TEST_CASE("two inertias joined by a gear move as one that adds up, behind a thin dashpot, from rest") {
  constexpr double J0 = 0.37, J1 = 0.92;
  for (const double ratio : {2.0, -0.7, 1.0}) {
    for (const double n : {0.1, 0.3, 1.7}) {
      for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(ratio);
        CAPTURE(n);
        CAPTURE(accuracy);
        const auto run = [&](double inertia, const std::string& geared) {
          return simulate(fmt::format(R"(domain = "rotation"
[elements]
T = {{ type = "torque", at = "n0", torque = {{ sine = 0.11, frequency = 1 }} }}
d = {{ type = "dashpot", between = ["n0", "ground"], damping = 4, flow_index = {} }}
J = {{ type = "inertia", at = "n0", inertia = {} }}
{}
[simulate]
stop = 2
record = ["n0.velocity", "d.force"]
output = {{ every = 0.04 }}
)", n, inertia, geared), accuracy);
        };
        const RunTable one = run(J0 + J1 / (ratio * ratio), "");
        const RunTable two = run(J0, fmt::format("g = {{ type = \"gear\", between = [\"n0\", \"n1\"], ratio = {} }}\nJ1 = {{ type = \"inertia\", at = \"n1\", inertia = {} }}", ratio, J1));
        for (const char* record : {"n0.velocity", "d.force"}) {
          for (std::size_t row = 0; row < one.time().size(); ++row) CHECK(std::abs(two[record][row] - one[record][row]) <= 2 * accuracy * one.scale(record));
        }
      }
    }
  }
}

}  // namespace rheonet::test::geared_inertias_are_one_test
