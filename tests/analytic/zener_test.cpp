// The standard linear solid (Zener): a spring k0 in parallel with a Maxwell branch, spring k1 and dashpot B in series.
#include <doctest/doctest.h>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::zener_test {

namespace {

constexpr double k0 = 61.3, k1 = 118.7, B = 19.9, stop = 1.31;

const std::string wired = R"(
[elements.body]
between = ["end", "ground"]
parallel = [
  { name = "spring", type = "spring", stiffness = "k0" },
  { series = [ { name = "spring1", type = "spring", stiffness = "k1" },
               { name = "dashpot1", type = "dashpot", damping = "B" } ] },
]
)";

// By nodes, and every element the other way round: all its signs change.
const std::string reversed = R"(
[elements]
spring   = { type = "spring",  between = ["ground", "end"], stiffness = "k0" }
dashpot1 = { type = "dashpot", between = ["ground", "mid"], damping = "B" }
spring1  = { type = "spring",  between = ["mid", "end"],    stiffness = "k1" }
)";

void check_strained(const Strain& strain) {
  const Response& w = strain.velocity;
  const Response x = strain.position();
  const Response f1 = (B * w).lag(B / k1, k1 * strain.jump);
  const Response f = k0 * x + f1;
  const auto after = [](const Response& response) { return from(drive_start, response); };
  CAPTURE(strain.name);
  check_at_all_accuracies(netlist({{"k0", k0}, {"k1", k1}, {"B", B}}, strain.element + wired, stop),
                          {
                              {"body.force", after(f)},
                              {"drive.force", after(f)},
                              {"body.spring.force", after(k0 * x)},
                              {"body.spring1.force", after(f1)},
                              {"body.spring1.displacement", after(f1 / k1)},
                              {"body.spring1.velocity", after(w - f1 / B)},
                              {"body.dashpot1.displacement", after(x - f1 / k1)},
                              {"body.dashpot1.velocity", after(f1 / B)},
                              {"body.displacement", after(x)},
                          });
  check_at_all_accuracies(netlist({{"k0", k0}, {"k1", k1}, {"B", B}}, strain.element + reversed, stop),
                          {
                              {"drive.force", after(f)},
                              {"spring.force", after(-k0 * x)},
                              {"spring1.force", after(-1.0 * f1)},
                              {"dashpot1.force", after(-1.0 * f1)},
                              {"dashpot1.velocity", after(-1 / B * f1)},
                              {"mid.position", after(x - f1 / k1)},
                              {"mid.velocity", after(f1 / B)},
                          });
}

}  // namespace

TEST_CASE("Zener, strained") {
  for (const Strain& strain : smooth_strains()) check_strained(strain);
}

TEST_CASE("Zener, stretched suddenly") {
  for (const Strain& strain : sudden_strains()) check_strained(strain);
}

TEST_CASE("Zener, loaded") {
  for (const Load& load : loads()) {
    // y is the displacement of the dashpot: k1 (x - y) = B y' and k0 x + k1 (x - y) = f; x is eliminated.
    const Response& f = load.force;
    const Response y = (f / k0).lag(B * (k0 + k1) / (k0 * k1), 0);
    const Response x = (f + k1 * y) / (k0 + k1);
    const Response f1 = k1 * (x - y);
    const auto after = [](const Response& response) { return from(drive_start, response); };
    CAPTURE(load.name);
    check_at_all_accuracies(netlist({{"k0", k0}, {"k1", k1}, {"B", B}}, load.element + wired, stop),
                            {
                                {"body.force", after(f)},
                                {"body.spring.force", after(k0 * x)},
                                {"body.spring1.force", after(f1)},
                                {"body.spring1.displacement", after(x - y)},
                                {"body.dashpot1.force", after(f1)},
                                {"body.dashpot1.displacement", after(y)},
                                {"body.dashpot1.velocity", after(f1 / B)},
                                {"end.position", after(x)},
                                {"end.velocity", after(x.derivative())},
                            });
  }
}

}  // namespace rheonet::test::zener_test
