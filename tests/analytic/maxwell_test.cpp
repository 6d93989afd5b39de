// Spring k and dashpot B in series (Maxwell 1855): (B/k) df/dt + f = B w.
#include <doctest/doctest.h>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::maxwell_test {

namespace {

constexpr double k = 137.3, B = 21.7, stop = 1.19;

const std::string wired = R"(
[elements.body]
between = ["end", "ground"]
series = [
  { name = "spring", type = "spring", stiffness = "k" },
  { name = "dashpot", type = "dashpot", damping = "B" },
]
)";

void check_strained(const Strain& strain) {
  const Response& w = strain.velocity;
  const Response x = strain.position();
  const Response f = (B * w).lag(B / k, k * strain.jump);
  const auto after = [](const Response& response) { return from(drive_start, response); };
  CAPTURE(strain.name);
  check_at_all_accuracies(netlist({{"k", k}, {"B", B}}, strain.element + wired, stop),
                          {
                              {"body.force", after(f)},
                              {"drive.force", after(f)},
                              {"body.spring.force", after(f)},
                              {"body.dashpot.force", after(f)},
                              {"body.spring.displacement", after(f / k)},
                              {"body.spring.velocity", after(w - f / B)},
                              {"body.dashpot.displacement", after(x - f / k)},
                              {"body.dashpot.velocity", after(f / B)},
                              {"body.displacement", after(x)},
                              {"body.velocity", after(w)},
                              {"end.position", after(x)},
                              {"end.velocity", after(w)},
                          });
}

}  // namespace

TEST_CASE("Maxwell, strained") {
  for (const Strain& strain : smooth_strains()) check_strained(strain);
}

TEST_CASE("Maxwell, stretched suddenly") {
  for (const Strain& strain : sudden_strains()) check_strained(strain);
}

TEST_CASE("Maxwell, loaded") {
  for (const Load& load : loads()) {
    const Response& f = load.force;
    const Response flow = (f / B).integral();
    const auto after = [](const Response& response) { return from(drive_start, response); };
    CAPTURE(load.name);
    check_at_all_accuracies(netlist({{"k", k}, {"B", B}}, load.element + wired, stop),
                            {
                                {"body.force", after(f)},
                                {"body.spring.force", after(f)},
                                {"body.dashpot.force", after(f)},
                                {"body.spring.displacement", after(f / k)},
                                {"body.dashpot.displacement", after(flow)},
                                {"body.dashpot.velocity", after(f / B)},
                                {"end.position", after(f / k + flow)},
                                {"end.velocity", after(f.derivative() / k + f / B)},
                            });
  }
}

}  // namespace rheonet::test::maxwell_test
