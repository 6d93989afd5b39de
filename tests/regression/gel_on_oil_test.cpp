#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "core/network/component.hpp"
#include "tests/support/reference_integrator.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::gel_on_oil_test {

namespace {

/// The independent integrator sees the same, as far as it is sure of it.
void check_against_reference(const std::string& netlist, const test::RunTable& run) {
  const Scene scene = test::scene_of(netlist);
  const test::ReferenceSolution reference = test::integrate_reference(scene, declarations());
  REQUIRE(reference.complete);
  std::size_t sure = 0, values = 0;
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    const test::ReferenceSolution::Column& column = reference.columns[k];
    const std::string& name = run.header[k + 1];
    CAPTURE(name);
    REQUIRE_EQ(column.value.size(), run[name].size());
    double worst = 0;
    for (std::size_t i = 0; i < column.value.size(); ++i) {
      ++values;
      REQUIRE(std::isfinite(run[name][i]));
      if (!(column.error[i] <= 1e-3 * column.scale)) continue;
      ++sure;
      worst = std::max(worst, std::abs(run[name][i] - column.value[i]) - 4 * column.error[i]);
    }
    CHECK(worst <= 1e-4 * column.scale);
  }
  CHECK(10 * sure >= 8 * values);
}

}  // namespace

// The gel starts by 1e-26 m while the oil under it moves 1e-9 m: its velocity was the rounding of theirs, and the run
// followed it. And where the gel turns its force goes steeply through 0: the event came when the velocity was noise, the
// force still was not, and friction beside it was given a force that it could not have. Beside friction the start of the gel
// is slower than any number: the friction, at rest so far, was not seen to leave it, and bent like a spring ever after.
TEST_CASE("a pseudoplastic gel with friction beside it, on oil, starts from rest and turns") {
  const std::string friction[] = {R"(type = "vfm", stiffness = 92, damping = 8.2)", R"(type = "sfm", stiffness = 92, coulomb = 0.17)",
                                  R"(type = "cfm", stiffness = 92, coulomb = 0.17, damping = 8.2)"};
  for (const std::string& beside : friction) {
    for (const double flow_index : {1.0, 1.75}) {
      for (const char* drive : {"sine", "cosine"}) {
        const std::string netlist = std::string("[elements]\ndrive = { type = \"motion\", at = \"top\", velocity = { ") + drive +
                                    " = 2, frequency = 0.5 } }\n"
                                    "gel = { type = \"dashpot\", between = [\"top\", \"mid\"], damping = 3.5, flow_index = 0.3 }\n"
                                    "dry = { between = [\"top\", \"mid\"], " + beside + " }\n"
                                    "oil = { type = \"dashpot\", between = [\"mid\", \"ground\"], damping = 1.4, flow_index = " +
                                    std::to_string(flow_index) + " }\n[simulate]\nstop = 3\noutput = { points = 61 }\n";
        CAPTURE(netlist);
        const test::RunTable fine = test::simulate(netlist, 1e-9);
        check_against_reference(netlist, fine);
        for (const double accuracy : {1e-3, 1e-6}) {
          CAPTURE(accuracy);
          const test::RunTable run = test::simulate(netlist, accuracy);
          for (const char* record : {"oil.force", "mid.velocity", "dry.force"}) {
            CAPTURE(record);
            double worst = 0;
            for (std::size_t i = 0; i < run.time().size(); ++i) worst = std::max(worst, std::abs(run[record][i] - fine[record][i]));
            CHECK(worst <= 10 * accuracy * fine.scale(record));
          }
        }
      }
    }
  }
}

}  // namespace rheonet::test::gel_on_oil_test
