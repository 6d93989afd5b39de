// Spring k and dashpot B in parallel (Kelvin and Voigt): f = k d + B w.
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::kelvin_voigt_test {

namespace {

constexpr double k = 83.9, B = 11.3, stop = 1.23;

const std::string wired = R"(
[elements.body]
between = ["end", "ground"]
parallel = [
  { name = "spring", type = "spring", stiffness = "k" },
  { name = "dashpot", type = "dashpot", damping = "B" },
]
)";

}  // namespace

TEST_CASE("Kelvin-Voigt, strained") {
  for (const Strain& strain : smooth_strains()) {
    const Response& w = strain.velocity;
    const Response x = strain.position();
    const auto after = [](const Response& response) { return from(drive_start, response); };
    CAPTURE(strain.name);
    check_at_all_accuracies(netlist({{"k", k}, {"B", B}}, strain.element + wired, stop),
                            {
                                {"body.force", after(k * x + B * w)},
                                {"drive.force", after(k * x + B * w)},
                                {"body.spring.force", after(k * x)},
                                {"body.dashpot.force", after(B * w)},
                                {"body.spring.displacement", after(x)},
                                {"body.dashpot.velocity", after(w)},
                                {"body.displacement", after(x)},
                                {"end.velocity", after(w)},
                            });
  }
}

TEST_CASE("Kelvin-Voigt, loaded") {
  for (const Load& load : loads()) {
    const Response& f = load.force;
    const Response x = (f / k).lag(B / k, 0);
    const Response w = x.derivative();
    const auto after = [](const Response& response) { return from(drive_start, response); };
    CAPTURE(load.name);
    check_at_all_accuracies(netlist({{"k", k}, {"B", B}}, load.element + wired, stop),
                            {
                                {"body.force", after(f)},
                                {"body.spring.force", after(k * x)},
                                {"body.dashpot.force", after(B * w)},
                                {"body.spring.velocity", after(w)},
                                {"body.dashpot.displacement", after(x)},
                                {"end.position", after(x)},
                                {"end.velocity", after(w)},
                            });
  }
}

// The dashpot needs an impulse to be stretched at once. A simulator may refuse that; if it does not, the forces before
// and after it are those of a spring.
TEST_CASE("Kelvin-Voigt, stretched suddenly: the forces after the impulse") {
  for (const Strain& strain : sudden_strains()) {
    const Response& w = strain.velocity;
    const Response x = strain.position();
    CAPTURE(strain.name);
    for (const double accuracy : accuracies) {
      RunTable trajectory;
      try {
        trajectory = simulate(netlist({{"k", k}, {"B", B}}, strain.element + wired, stop), accuracy);
      } catch (const std::runtime_error& refused) {
        const std::string reason = refused.what();
        CHECK_MESSAGE((reason.find("drive") != reason.npos || reason.find("dashpot") != reason.npos), reason);
        continue;
      }
      check_against(trajectory, {"body.force", from(drive_start, k * x + B * w)}, accuracy);
      check_against(trajectory, {"body.spring.displacement", from(drive_start, x)}, accuracy);
    }
  }
}

}  // namespace rheonet::test::kelvin_voigt_test
