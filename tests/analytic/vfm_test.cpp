// The viscous friction model: (B/sigma) df/dt + f = B w (thesis, Eq. 13).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/analytic/drives.hpp"
#include "tests/support/check.hpp"

namespace rheonet::test::vfm_test {

namespace {

constexpr double B = 18.3, sigma = 211.9, stop = 0.97;

const std::string element = R"(
[elements.oil]
type = "vfm"
between = ["end", "ground"]
damping = "B"
stiffness = "sigma"
)";

std::string scene(const std::string& tables) { return netlist({{"B", B}, {"sigma", sigma}}, tables, stop); }

}  // namespace

TEST_CASE("vfm after a stop: Eq. 24 of the thesis") {
  const double w0 = 0.731, stopped = 0.2143;
  const std::string drive = R"(
[elements.drive]
type = "motion"
at = "end"
velocity = { step = -0.731, offset = 0.731, time = 0.2143 }
)";
  const auto torque = [=](double t) { return t < stopped ? B * w0 : B * w0 * std::exp(-sigma * (t - stopped) / B); };
  check_at_all_accuracies(scene(drive + element + "f0 = \"B*0.731\"\n"),
                          {
                              {"oil.force", torque},
                              {"drive.force", torque},
                              {"oil.velocity", [=](double t) { return t < stopped ? w0 : 0; }},
                              {"oil.displacement", [=](double t) { return w0 * std::min(t, stopped); }},
                          });
}

TEST_CASE("vfm from rest and from a given force") {
  const double w0 = -0.467, f0 = 4.13;
  const std::string drive = "[elements.drive]\ntype = \"motion\"\nat = \"end\"\nvelocity = -0.467\n";
  const Response w = Response::constant(w0);
  check_at_all_accuracies(scene(drive + element), {{"oil.force", (B * w).lag(B / sigma, 0)}});
  check_at_all_accuracies(scene(drive + element + "f0 = 4.13\n"), {{"oil.force", (B * w).lag(B / sigma, f0)}});
}

TEST_CASE("vfm, strained") {
  std::vector<Strain> strains = smooth_strains();
  for (const Strain& sudden : sudden_strains()) strains.push_back(sudden);
  for (const Strain& strain : strains) {
    const Response f = (B * strain.velocity).lag(B / sigma, sigma * strain.jump);
    CAPTURE(strain.name);
    check_at_all_accuracies(scene(strain.element + element),
                            {
                                {"oil.force", from(drive_start, f)},
                                {"drive.force", from(drive_start, f)},
                                {"oil.displacement", from(drive_start, strain.position())},
                            });
  }
}

TEST_CASE("vfm, loaded") {
  for (const Load& load : loads()) {
    const Response& f = load.force;
    const Response x = f / sigma + (f / B).integral();
    CAPTURE(load.name);
    check_at_all_accuracies(scene(load.element + element), {
                                                               {"oil.force", from(drive_start, f)},
                                                               {"oil.displacement", from(drive_start, x)},
                                                               {"end.velocity", from(drive_start, x.derivative())},
                                                           });
  }
}

// The same law in two ways. The integrator controls the errors of both together, with one step size, so they differ by
// less than either is off; at this accuracy that is close to rounding.
TEST_CASE("vfm is a wired Maxwell element") {
  const std::string wired = R"(
[elements.wired]
between = ["end", "ground"]
series = [ { type = "spring", stiffness = "sigma" }, { type = "dashpot", damping = "B" } ]
)";
  const double accuracy = 1e-11;
  for (const Strain& strain : smooth_strains()) {
    const RunTable both = simulate(scene(strain.element + element + wired), accuracy);
    const double scale = both.scale("oil.force");
    CHECK_GT(scale, 1);
    for (std::size_t row = 0; row < both.time().size(); ++row) {
      CAPTURE(row);
      CHECK_LE(std::abs(both["oil.force"][row] - both["wired.force"][row]), 10 * accuracy * scale);
    }
  }
}

}  // namespace rheonet::test::vfm_test
