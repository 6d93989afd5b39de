// Burgers' material: spring k1, dashpot B1, and a Kelvin-Voigt element (spring k2 parallel to dashpot B2), all in
// series.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::burgers_test {

namespace {

constexpr double k1 = 143.7, B1 = 29.3, k2 = 87.1, B2 = 7.7, stop = 1.27;

const std::string wired = R"(
[elements.body]
between = ["end", "ground"]
series = [
  { name = "spring1", type = "spring", stiffness = "k1" },
  { name = "dashpot1", type = "dashpot", damping = "B1" },
  { name = "solid", parallel = [ { name = "spring2", type = "spring", stiffness = "k2" },
                                 { name = "dashpot2", type = "dashpot", damping = "B2" } ] },
]
)";

std::string scene(const std::string& drive) {
  return netlist({{"k1", k1}, {"B1", B1}, {"k2", k2}, {"B2", B2}}, drive + wired, stop);
}

// a2 f'' + a1 f' + f = B1 w + (B1 B2/k2) w', whose modes are exp(-r1 t) and exp(-r2 t).
void check_strained(const Strain& strain) {
  const Response& w = strain.velocity;
  const Response x = strain.position();
  const double a2 = B1 * B2 / (k1 * k2), a1 = B1 / k1 + B1 / k2 + B2 / k2;
  const double r1 = (a1 + std::sqrt(a1 * a1 - 4 * a2)) / (2 * a2), r2 = 1 / (a2 * r1);
  // At first only spring1 is stretched, and both dashpots bear its force.
  const double f0 = k1 * strain.jump, df0 = k1 * (w(0) - f0 / B1 - f0 / B2);
  const Response f = (B1 * w + (B1 * B2 / k2) * w.derivative()).second_order(r1, r2, f0, df0);
  const Response y = (f / k2).lag(B2 / k2, 0);
  const auto after = [](const Response& response) { return from(drive_start, response); };
  CAPTURE(strain.name);
  check_at_all_accuracies(scene(strain.element), {
                                                     {"body.force", after(f)},
                                                     {"drive.force", after(f)},
                                                     {"body.spring1.displacement", after(f / k1)},
                                                     {"body.spring1.velocity", after(f.derivative() / k1)},
                                                     {"body.dashpot1.displacement", after((f / B1).integral())},
                                                     {"body.dashpot1.velocity", after(f / B1)},
                                                     {"body.solid.force", after(f)},
                                                     {"body.solid.displacement", after(y)},
                                                     {"body.solid.velocity", after(y.derivative())},
                                                     {"body.solid.spring2.force", after(k2 * y)},
                                                     {"body.solid.dashpot2.force", after(B2 * y.derivative())},
                                                     {"body.displacement", after(x)},
                                                 });
}

}  // namespace

TEST_CASE("Burgers, strained") {
  for (const Strain& strain : smooth_strains()) check_strained(strain);
}

TEST_CASE("Burgers, stretched suddenly") {
  for (const Strain& strain : sudden_strains()) check_strained(strain);
}

TEST_CASE("Burgers, loaded") {
  for (const Load& load : loads()) {
    const Response& f = load.force;
    const Response y = (f / k2).lag(B2 / k2, 0);
    const Response flow = (f / B1).integral();
    const auto after = [](const Response& response) { return from(drive_start, response); };
    CAPTURE(load.name);
    check_at_all_accuracies(scene(load.element),
                            {
                                {"body.force", after(f)},
                                {"body.spring1.displacement", after(f / k1)},
                                {"body.dashpot1.displacement", after(flow)},
                                {"body.dashpot1.velocity", after(f / B1)},
                                {"body.solid.displacement", after(y)},
                                {"body.solid.velocity", after(y.derivative())},
                                {"body.solid.spring2.force", after(k2 * y)},
                                {"body.solid.dashpot2.force", after(f - k2 * y)},
                                {"end.position", after(f / k1 + flow + y)},
                                {"end.velocity", after(f.derivative() / k1 + f / B1 + y.derivative())},
                            });
  }
}

}  // namespace rheonet::test::burgers_test
