// Friction models and stops with parameters that vary in time.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/result/certify.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::varying_friction_test {

namespace {

/// A mass that a sine pushes, with all these elements at it.
std::string pushed(const std::string& elements) {
  return R"~(
[elements]
m = { type = "mass", at = "a", mass = 1.3 }
F = { type = "force", at = "a", force = { sine = 7, frequency = 0.8 } }
)~" + elements;
}

}  // namespace

TEST_CASE("varying friction: signals that do not vary give the forces of the constant law") {
  // The constant laws have closed forms between their reversals; those with signals are states of blocks. Both directions of each element.
  const auto elements = [](bool varies) {
    const auto value = [&](double x) { return varies ? fmt::format("{{ table = [[0, {0}], [9, {0}]] }}", x) : fmt::format("{}", x); };
    return fmt::format(R"~(
v1 = {{ type = "vfm", between = ["a", "ground"], damping = {}, stiffness = 40, f0 = 0.7 }}
v2 = {{ type = "vfm", between = ["ground", "a"], damping = 2, stiffness = {} }}
s1 = {{ type = "sfm", between = ["a", "ground"], coulomb = {}, stiffness = 90, exponent = 1.4, f0 = -0.4 }}
s2 = {{ type = "sfm", between = ["ground", "a"], coulomb = 0.8, stiffness = {}, exponent = 1 }}
c1 = {{ type = "cfm", between = ["a", "ground"], coulomb = 1.5, stiffness = 70, damping = {}, exponent = 1.2, f0 = 0.3 }}
c2 = {{ type = "cfm", between = ["ground", "a"], coulomb = {}, stiffness = 60, damping = {}, exponent = 2 }}
t1 = {{ type = "stop", between = ["a", "ground"], upper = 0.05, lower = -0.07, stiffness = {}, damping = 6 }}
t2 = {{ type = "stop", between = ["ground", "a"], upper = 0.04, stiffness = 300, damping = {} }}
)~", value(3), value(35), value(2), value(80), value(5), value(1.1), value(4), value(400), value(9));
  };
  const std::string run = "[simulate]\nstop = 4\naccuracy = 1e-8\noutput = { points = 41 }\n";
  const RunTable constant = simulate(pushed(elements(false)) + run), varying = simulate(pushed(elements(true)) + run);
  CHECK(largest_error(varying, constant) < 2e-8);
}

TEST_CASE("varying friction: a dashpot in series with a spring, whose damping rises in time") {
  const double V = 0.37, k = 21, B0 = 3, b = 4;
  const RunTable rows = simulate(fmt::format(R"~(
[elements]
drive = {{ type = "motion", at = "a", velocity = {} }}
v = {{ type = "vfm", between = ["a", "ground"], damping = {{ ramp = {}, offset = {} }}, stiffness = {} }}
)~", V, b, B0, k) + simulate_until(2));
  // f' = k (V - f/B) with B = B0 + b t is solved by f = c B + C B^(-k/b) with c b = k (V - c).
  const double c = k * V / (k + b), C = -c * std::pow(B0, 1 + k / b);
  CHECK(error_of(rows, "v.force", [&](double t) { return c * (B0 + b * t) + C * std::pow(B0 + b * t, -k / b); }) < 1e-9);
}

TEST_CASE("varying friction: solid friction whose bound falls while it slides") {
  // f' = sigma w (1 - f/Fc) with Fc = F0 exp(-a t) and constant w: f = sigma w exp(-q(t)) times the integral of exp(q), q' = sigma w/Fc.
  const double w = 0.2, sigma = 30, F0 = 4, a = 0.5, s = sigma * w;
  const RunTable rows = simulate(fmt::format(R"~(
[parameters]
F0 = "{} N"
T  = "{} s"
[elements]
drive = {{ type = "motion", at = "a", velocity = {} }}
f = {{ type = "sfm", between = ["a", "ground"], coulomb = {{ block = "decay" }}, stiffness = {} }}
decay = {{ type = "function", in = ["drive.velocity"], out = "F0*exp(-t/T)" }}
)~", F0, 1 / a, w, sigma) + simulate_until(2));
  const auto q = [&](double t) { return s / (F0 * a) * (std::exp(a * t) - 1); };
  // Simpson's rule for the integral.
  const auto exact = [&](double t) {
    constexpr int n = 4000;
    double sum = 0;
    for (int i = 0; i <= n; ++i) sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * std::exp(q(t * i / n) - q(t));
    return s * sum * t / (3 * n);
  };
  CHECK(error_of(rows, "f.force", exact) < 1e-8);
}

TEST_CASE("varying friction: a bound that swings, with any exponent, gives certified results") {
  for (const double exponent : {1.0, 1.5, 2.5}) {
    CAPTURE(exponent);
    const Scene scene = scene_of(fmt::format(R"~(
[elements]
F = {{ type = "force", at = "a", force = {{ sine = 3, frequency = 1.3 }} }}
m = {{ type = "mass", at = "a", mass = 0.05 }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = 5 }}
x = {{ type = "sfm", between = ["a", "ground"], stiffness = 40, exponent = {}, coulomb = {{ sine = 1, frequency = 1, offset = 2 }} }}
[simulate]
stop = 1.5
accuracy = 1e-6
output = {{ points = 16 }}
)~", exponent));
    CHECK(certify(scene, {}).holds);
  }
}

TEST_CASE("varying friction: the energy of a stop that stiffens while it is pressed") {
  // A prescribed motion presses it: the force is k(t) (d - d2), and the rest of the energy comes from what stiffens it.
  const double V = 0.5, d2 = 0.2, k0 = 40, b = 30;
  const Scene scene = scene_of(fmt::format(R"~(
[elements]
drive = {{ type = "motion", at = "a", velocity = {} }}
t = {{ type = "stop", between = ["a", "ground"], upper = {}, stiffness = {{ ramp = {}, offset = {} }} }}
)~", V, d2, b, k0) + simulate_until(1) + "record = [\"t.force\", \"t.energy\", \"t.dissipated\"]\n");
  Summary summary;
  const RunTable rows = simulate(scene, &summary);
  const auto x = [&](double t) { return std::max(0.0, V * t - d2); };
  CHECK(error_of(rows, "t.force", [&](double t) { return (k0 + b * t) * x(t); }) < 1e-9);
  CHECK(error_of(rows, "t.energy", [&](double t) { return (k0 + b * t) * x(t) * x(t) / 2; }) < 1e-9);
  for (const double heat : rows["t.dissipated"]) CHECK(heat == 0);
  CHECK(certify(scene, {}).holds);
}

TEST_CASE("varying friction: what cannot be is refused by name") {
  const auto told = [](const std::string& element) {
    return refusal("[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\nx = { between = [\"a\", \"ground\"], " + element + " }\n[simulate]\nstop = 1\n");
  };
  const auto says = [&](const std::string& element, const std::string& what) {
    const std::string message = told(element);
    CAPTURE(message);
    CHECK(message.find(what) != message.npos);
  };
  const std::string ramp = "{ ramp = 1, offset = 1 }";
  says("type = \"vfm\", stiffness = \"inf\", damping = " + ramp, "`stiffness` must be finite where another parameter varies");
  says("type = \"vfm\", stiffness = 1, delay = 1, damping = " + ramp, "`delay` needs a constant `damping` and a constant `stiffness`");
  says("type = \"sfm\", stiffness = 1, exponent = 0.5, coulomb = " + ramp, "`exponent` must be at least 1 where another parameter varies");
  says("type = \"sfm\", coulomb = 1, f0 = 0.5, stiffness = " + ramp, "`f0` needs a constant `stiffness`");
  says("type = \"cfm\", coulomb = \"inf\", stiffness = 1, damping = " + ramp, "`coulomb` must be finite where another parameter varies");
  says("type = \"stop\", upper = 1, stiffness = \"inf\", damping = " + ramp, "`damping` is that of an elastic stop");
  says("type = \"stop\", upper = 1, d0 = 0, stiffness = " + ramp, "`d0` needs a constant `stiffness` and `damping`");
  says("type = \"sfm\", stiffness = 1, coulomb = { ramp = -1, offset = 0.5 }", "at t = 0.5 s, the law of `x` has no finite force, or no finite slope (d = 0, w = 0, coulomb = 0");
  const std::string massless = refusal("[elements]\nx = { type = \"sfm\", between = [\"a\", \"ground\"], stiffness = 1, coulomb = " + ramp + " }\n[simulate]\nstop = 1\n");
  CAPTURE(massless);
  CHECK(massless.find("node `a` has no mass") != massless.npos);
}

}  // namespace rheonet::test::varying_friction_test
