// A mass on an elastic-perfectly-plastic frame (sfm of exponent 0) with a dashpot beside it, pushed by half a sine:
// m x'' + c x' + f = F, f' = sigma x' but for abs(f) = Fc. The example is Chopra's, Dynamics of Structures (kip, inch,
// second); the solution here is exact, phase by phase.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/analytic/sliding_motion.hpp"
#include "tests/support/check.hpp"
#include "tests/support/response.hpp"

namespace rheonet::test::elastoplastic_test {

namespace {

constexpr double m = 0.2533, sigma = 10, Fc = 7.5, push = 10, pulse = 0.6, stop = 1.193;
const double c = 2 * 0.05 * std::sqrt(sigma * m);

constexpr double looks = 2000;  // places in a stretch where its end is looked for

/// One stretch without a change of the law or of the push.
struct Phase {
  double start;
  Response position;
  Response friction;
};

std::vector<Phase> phases() {
  std::vector<Phase> result;
  double t = 0, x = 0, v = 0, f = 0;
  int yielding = 0;  // the sign of the friction while it is at its bound
  while (t < stop) {
    const double end = t < pulse ? pulse : stop;
    const double omega = std::numbers::pi / pulse;
    const Response force = t < pulse ? Response::sine(push, omega, omega * t) : Response();
    Response position, friction;
    double duration;
    if (yielding == 0) {
      // m x'' + c x' + sigma x = F + sigma x0 - f0
      const double omega0 = std::sqrt(sigma / m), zeta = c / (2 * std::sqrt(sigma * m));
      const Response::Complex root = std::sqrt(Response::Complex(zeta * zeta - 1));
      position = ((force + Response::constant(sigma * x - f)) / sigma)
                     .second_order(omega0 * (zeta + root), omega0 * (zeta - root), x, v);
      friction = Response::constant(f - sigma * x) + sigma * position;
      duration = first_crossing([&](double s) { return std::abs(friction(s)) - Fc; }, end - t, (end - t) / looks);
    } else {
      // m v' + c v = F - Fc s
      const Response velocity = ((force - Response::constant(Fc * yielding)) / c).lag(m / c, v);
      position = velocity.integral(x);
      friction = Response::constant(Fc * yielding);
      duration = first_crossing([&](double s) { return -yielding * velocity(s); }, end - t, (end - t) / looks);
    }
    result.push_back({t, position, friction});
    const bool switched = t + duration < end;
    x = position(duration), v = position.derivative()(duration), f = friction(duration);
    if (switched) {
      yielding = yielding == 0 ? (f > 0 ? 1 : -1) : 0;
      f = std::clamp(f, -Fc, Fc);
    }
    t = switched ? t + duration : end;
  }
  return result;
}

}  // namespace

TEST_CASE("A mass on an elastic-plastic frame") {
  const std::vector<Phase> all = phases();
  REQUIRE_GE(all.size(), 4);  // elastic, yielding, the end of the push, elastic again
  const auto at = [&](const auto& pick) {
    return [&all, pick](double t) {
      std::size_t j = all.size() - 1;
      while (all[j].start > t) --j;
      return pick(all[j], t - all[j].start);
    };
  };
  // The push ends when a second sine, half a period later, begins to cancel the first.
  const std::string tables = R"(
[elements]
push    = { type = "force", at = "floor", force = { sine = "push", frequency = "0.5/pulse" } }
release = { type = "force", at = "floor", force = { sine = "push", frequency = "0.5/pulse", time = "pulse" } }
floor_mass = { type = "mass", at = "floor", mass = "m" }
damper  = { type = "dashpot", between = ["floor", "ground"], damping = "c" }
frame   = { type = "sfm", between = ["floor", "ground"], stiffness = "sigma", coulomb = "Fc", exponent = 0 }
)";
  check_at_all_accuracies(
      netlist({{"m", m}, {"c", c}, {"sigma", sigma}, {"Fc", Fc}, {"push", push}, {"pulse", pulse}}, tables, stop),
      {
          {"floor.position", at([](const Phase& phase, double t) { return phase.position(t); })},
          {"floor.velocity", at([](const Phase& phase, double t) { return phase.position.derivative()(t); })},
          {"frame.force", at([](const Phase& phase, double t) { return phase.friction(t); })},
          {"damper.force", at([](const Phase& phase, double t) { return c * phase.position.derivative()(t); })},
      });
}

}  // namespace rheonet::test::elastoplastic_test
