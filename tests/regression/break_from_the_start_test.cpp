// The break that a delay transmits from the start of a run came too early by a round-off error. The step size before it went to 0, and the
// stored velocity belonged to neither side. Now times that differ from 0 by the round-off of larger times count as 0.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/check.hpp"
#include "tests/support/response.hpp"

namespace rheonet::test::break_from_the_start_test {

// Interval by interval: f_j from j TD on, T f_j' + f_j = B (w - f_(j-1)'/k), as the middle node moves at w - f'/k.
TEST_CASE("vfm with a delay behind a spring, drawn at a steady rate") {
  constexpr double B = 0.494, sigma = 1.675, k = 4.33, w = 7.3, f0 = -1.3, T = B / sigma;
  for (const double delay : {0.17042258358836199, 0.1137, 0.0731}) {
    std::vector<Response> forces = {Response().lag(T, f0)};
    for (int j = 1; j < 6; ++j) {
      const Response& last = forces.back();
      forces.push_back((B * (Response::constant(w) - last.derivative() / k)).lag(T, last(delay)));
    }
    const auto force = [&](double t) {
      const std::size_t j = std::min(forces.size() - 1, std::size_t(t / delay));
      return forces[j](t - double(j) * delay);
    };
    CAPTURE(delay);
    check_at_all_accuracies(fmt::format(R"(
[elements]
drive = {{ type = "motion", at = "a", velocity = {:.17g} }}
k1    = {{ type = "spring", between = ["a", "mid"], stiffness = {:.17g} }}
v     = {{ type = "vfm", between = ["mid", "ground"], damping = {:.17g}, stiffness = {:.17g}, delay = {:.17g}, f0 = {} }}
[simulate]
stop = {:.17g}
output = {{ points = 177 }}
)",
                                        w, k, B, sigma, delay, f0, 5.93 * delay),
                            {{"v.force", force}, {"k1.force", force}});
  }
}

}  // namespace rheonet::test::break_from_the_start_test
