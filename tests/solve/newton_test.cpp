#include "core/solve/newton.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/probe.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::newton_test {

namespace {

std::string pushed_against(const std::string& flow_index) {
  return R"([elements]
push = { type = "force", at = "x", force = { sine = "3 N", frequency = "0.7 Hz" } }
m = { type = "mass", at = "x", mass = 1.3 }
k = { type = "spring", between = ["x", "ground"], stiffness = 2.1 }
c = { type = "dashpot", between = ["x", "ground"], damping = 0.8, flow_index = )" + flow_index + R"( }
[nodes]
x = { velocity = 0.7 }
[simulate]
stop = 3
)";
}

}  // namespace

TEST_CASE("the iteration meets the equations at the end of a step, and says how often it looked at them") {
  for (const char* flow_index : {"1", "0.4", "2.5"}) {
    CAPTURE(flow_index);
    for (const bool sparse : {false, true}) {
      CAPTURE(sparse);
      Probe probe(scene_of(pushed_against(flow_index)));
      Dae& dae = probe.dae();
      const std::size_t n = probe.y().size();
      const std::vector<double> tolerance(n, 1e-8), grain(n, 0), weight(n, 1e8);
      std::vector<double> y = probe.y(), yp = probe.yp(), correction(n), residual(n), still(n, 0);
      Newton newton(dae, sparse, tolerance, grain);
      newton.restart();
      // Backward Euler: from y on, predicted to stay there.
      double t = 0;
      for (const double h : {1e-3, 1e-3, 2e-3}) {
        const std::vector<double> before = y;
        t += h;
        REQUIRE(newton.solve({t, 1 / h, before.data(), still.data(), y.data(), yp.data()}, correction.data(), weight.data(), 1e-3));
        for (std::size_t i = 0; i < n; ++i) {
          y[i] = before[i] + correction[i];
          yp[i] = correction[i] / h;
        }
        dae.residual(t, y.data(), yp.data(), residual.data());
        for (const double r : residual) CHECK(std::abs(r) < 1e-7);
      }
      CHECK_FALSE(newton.singular());
      CHECK_EQ(newton.counts().failures, 0);
      CHECK_GE(newton.counts().jacobians, 2);  // one for each length of a step
      CHECK_GE(newton.counts().residuals, 3);
      if (flow_index == std::string("1")) CHECK_EQ(newton.counts().jacobians, 2);
    }
  }
}

}  // namespace rheonet::test::newton_test
