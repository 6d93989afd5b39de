// Scenes that are linear between events are solved in closed form: right to round-off, whatever accuracy is asked for.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "core/network/error.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::exact_arc_test {

namespace {

std::string by_arcs(const std::string& elements, double stop, const std::string& more = "") {
  return fmt::format("[elements]\n{}\n[simulate]\nmethod = \"exact\"\nstop = {}\noutput = {{ points = 201 }}\naccuracy = 1e-3\n{}", elements, stop, more);
}

struct Switch {
  double time;
  std::string what;
};

std::vector<Switch> switches(const Scene& scene, const std::string& element) {
  std::vector<Switch> result;
  run(scene, {.event = [&](double t, const std::string& name, const char* what, int) {
        if (name == element) result.push_back({t, what});
      }});
  return result;
}

}  // namespace

TEST_CASE("an oscillator keeps its phase over a thousand cycles") {
  constexpr double m = 0.7, k = 90, x0 = 1.3;
  const double omega = std::sqrt(k / m), stop = 1000.3 * 2 * M_PI / omega;
  Summary summary;
  const RunTable rows = simulate(scene_of(by_arcs(fmt::format("m = {{ type = \"mass\", at = \"a\", mass = {} }}\nk = {{ type = \"spring\", between = [\"a\", \"ground\"], stiffness = {} }}",
                                                              m, k), stop, fmt::format("[nodes]\na = {{ position = {} }}\n", x0))),
                                 &summary);
  CHECK_LE(error_of(rows, "a.position", [&](double t) { return x0 * std::cos(omega * t); }), 2e-11);  // 1e-12 of the phase: 6,285 rad
  CHECK_EQ(summary.arc_steps, summary.steps);
  CHECK_LE(std::abs(summary.missing), 3e-12 * summary.largest);
}

// A mass with a spring and a dashpot side by side: both sides of critical damping, and on it, where two eigenvalues are one.
TEST_CASE("damping just below, at and above the critical one") {
  constexpr double m = 1, omega = 3, x0 = 0.8;
  for (const double zeta : {0.0, 0.3, 1 - 1e-9, 1.0, 1 + 1e-9, 1.7, 40.0}) {
    CAPTURE(zeta);
    const RunTable rows = simulate(by_arcs(fmt::format(R"(m = {{ type = "mass", at = "a", mass = {} }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = {} }}
c = {{ type = "dashpot", between = ["a", "ground"], damping = {} }})", m, m * omega * omega, 2 * zeta * m * omega), 4, fmt::format("[nodes]\na = {{ position = {} }}\n", x0)));
    const std::complex<double> root = std::sqrt(std::complex<double>(zeta * zeta - 1));
    const auto exact = [&](double t) {
      const double decay = std::exp(-zeta * omega * t);
      if (std::abs(root) < 1e-3) {
        const double s = (zeta * zeta - 1) * omega * omega * t * t;  // cosh and sinh of its root by their series
        return x0 * decay * (1 + s / 2 + s * s / 24 + zeta * omega * t * (1 + s / 6 + s * s / 120));
      }
      // Without the difference of large numbers above critical damping.
      const auto slow = std::exp((-zeta + root) * omega * t), fast = std::exp((-zeta - root) * omega * t);
      return x0 * ((slow + fast) / 2.0 + zeta / root * (slow - fast) / 2.0).real();
    };
    CHECK_LE(error_of(rows, "a.position", exact), 2e-13);
  }
}

// A triple eigenvalue: mass, spring, and a Maxwell element beside it. With m = 1, (s + a)^3 = s^3 + 3 a s^2 + 3 a^2 s + a^3 belongs to
// K/B = 3 a, k + K = 3 a^2, k K/B = a^3.
TEST_CASE("three eigenvalues that are one") {
  constexpr double a = 2.1, k = a * a / 3, K = 3 * a * a - k, B = K / (3 * a), x0 = 1.1;
  const RunTable rows = simulate(by_arcs(fmt::format(R"(m = {{ type = "mass", at = "a", mass = 1 }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = {} }}
maxwell = {{ type = "vfm", between = ["a", "ground"], stiffness = {}, damping = {} }})", k, K, B), 5, fmt::format("[nodes]\na = {{ position = {} }}\n", x0)));
  // x(0) = x0, x'(0) = 0, x''(0) = -k x0, as the Maxwell element has no force yet.
  CHECK_LE(error_of(rows, "a.position", [&](double t) { return x0 * std::exp(-a * t) * (1 + a * t + (a * a - k) / 2 * t * t); }), 1e-13);
}

// E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I, section II.6: y'' + 0.2 y' + 4 sgn y' + y = 2 cos(pi t).
TEST_CASE("the times at which a forced oscillator with Coulomb friction switches") {
  const Scene scene = scene_of(by_arcs(R"(m = { type = "mass", at = "a", mass = 1 }
k = { type = "spring", between = ["a", "ground"], stiffness = 1 }
c = { type = "dashpot", between = ["a", "ground"], damping = 0.2 }
f = { type = "slider", between = ["a", "ground"], coulomb = 4 }
drive = { type = "force", at = "a", force = { cosine = 2, frequency = 0.5 } })", 6, "[nodes]\na = { position = 3, velocity = 4 }\n"));
  const std::vector<Switch> found = switches(scene, "f");
  const std::vector<double> published{0.562805325245349, 2.03520043404348, 2.62812675580974, 3.72719652274195, 4.68488217537249};
  REQUIRE_GE(found.size(), published.size());
  for (std::size_t k = 0; k < published.size(); ++k) CHECK_EQ(found[k].time, doctest::Approx(published[k]).epsilon(1e-13));
}

// J. P. Den Hartog, Transactions of the ASME 53 (1931) 107: the amplitude of a mass on a spring with Coulomb friction under a harmonic
// force, without stops: A = (P/k) sqrt(V^2 - (F/P)^2 U^2), with beta the ratio of frequencies.
TEST_CASE("Den Hartog's amplitude with dry friction") {
  constexpr double k = 1, m = 1, P = 1;
  for (const auto& [beta, F] : std::vector<std::pair<double, double>>{{0.6, 0.2}, {0.8, 0.5}, {1.4, 0.3}}) {
    CAPTURE(beta);
    const double angle = M_PI / beta, V = 1 / (1 - beta * beta), U = std::sin(angle) / (beta * (1 + std::cos(angle)));
    const double amplitude = P / k * std::sqrt(V * V - F * F * U * U / (P * P)), period = 2 * M_PI / beta;
    const RunTable rows = simulate(fmt::format(R"([elements]
m = {{ type = "mass", at = "a", mass = {} }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = {} }}
f = {{ type = "slider", between = ["a", "ground"], coulomb = {} }}
drive = {{ type = "force", at = "a", force = {{ cosine = {}, frequency = {:.17g} }} }}
[simulate]
method = "exact"
stop = {:.17g}
output = {{ points = 3, events = true }}
)", m, k, F, P, beta / (2 * M_PI), 200 * period));
    // It turns at its amplitude: the last events.
    CHECK_EQ(std::abs(rows["a.position"][rows.time().size() - 2]), doctest::Approx(amplitude).epsilon(1e-9));
  }
}

TEST_CASE("arcs and IDA agree on scenes of all linear laws, and the energy account closes") {
  const std::map<std::string, std::string> scenes{
      {"stick-slip", R"(drive = { type = "motion", at = "p", velocity = 0.1 }
k = { type = "spring", between = ["p", "b"], stiffness = 10 }
m = { type = "mass", at = "b", mass = 1 }
f = { type = "slider", between = ["b", "ground"], coulomb = 1, breakaway = 1.5 })"},
      {"Prandtl and Maxwell under two sines and a ramp", R"(one = { type = "force", at = "b", force = { sine = 2.3, frequency = 0.7 } }
two = { type = "force", at = "b", force = { sine = 0.9, frequency = 1.1, phase = 0.4 } }
three = { type = "force", at = "b", force = { ramp = 0.2, time = 1.5 } }
m = { type = "mass", at = "b", mass = 1.3 }
p = { type = "sfm", between = ["b", "ground"], stiffness = 23, coulomb = 1.2, exponent = 0 }
v = { type = "vfm", between = ["b", "ground"], stiffness = 11, damping = 1.7 })"},
      {"a massless node between a spring and two dashpots", R"(drive = { type = "motion", at = "end", position = { sine = 0.4, frequency = 0.9 } }
k = { type = "spring", between = ["end", "mid"], stiffness = 31 }
c = { type = "dashpot", between = ["mid", "b"], damping = 4 }
d = { type = "dashpot", between = ["mid", "ground"], damping = 2 }
m = { type = "mass", at = "b", mass = 0.6 }
f = { type = "slider", between = ["b", "ground"], coulomb = 0.3 })"},
      {"gears with losses, a stop and an inerter", R"(m1 = { type = "mass", at = "a", mass = 0.8 }
g = { type = "lever", between = ["a", "b"], ratio = 1.7, efficiency = 0.9 }
m2 = { type = "mass", at = "b", mass = 0.5 }
i = { type = "inerter", between = ["b", "c"], inertance = 0.4 }
m3 = { type = "mass", at = "c", mass = 0.9 }
k = { type = "spring", between = ["b", "c"], stiffness = 40 }
s = { type = "stop", between = ["c", "ground"], lower = -0.02, upper = 0.03, stiffness = 900 }
push = { type = "force", at = "a", force = { sine = 3, frequency = 0.8 } })"},
      {"a controller", R"(m = { type = "mass", at = "b", mass = 0.5 }
f = { type = "slider", between = ["b", "ground"], coulomb = 0.4 }
aim = { type = "generator", signal = { sine = 0.2, frequency = 0.4 } }
off = { type = "sum", in = ["aim.out", "-b.position"] }
sum = { type = "integrator", in = "off.out", gain = 3 }
hold = { type = "sample", in = "off.out", period = 0.01 }
push = { type = "force", at = "b", force = { block = "drive" } }
drive = { type = "sum", in = ["p.out", "sum.out"] }
p = { type = "gain", in = "hold.out", gain = 25 })"},
  };
  for (const auto& [what, elements] : scenes) {
    CAPTURE(what);
    const std::string toml = by_arcs(elements, 4.3);  // errors of IDA grow with every impact of the stop: a hundredfold until 7 s
    Summary by_closed_form;
    const RunTable exact = simulate(scene_of(toml), &by_closed_form);
    Scene asked = scene_of(toml, 1e-10);
    asked.method = Scene::Method::ida;
    Summary by_steps;
    const RunTable ida = simulate(asked, &by_steps);
    CHECK_LE(largest_error(ida, exact), 1e-8);
    CHECK_EQ(by_closed_form.arc_steps, by_closed_form.steps);
    CHECK_EQ(by_steps.arc_steps, 0);
    CHECK_EQ(by_closed_form.events, by_steps.events);
    CHECK_LE(by_closed_form.steps, by_steps.steps / 4);
    CHECK_LE(std::abs(by_closed_form.missing), 1e-12 * by_closed_form.largest);
  }
}

TEST_CASE("what is not linear is left to IDA, or named") {
  const std::string mass = "m = { type = \"mass\", at = \"b\", mass = 1 }\n";
  const std::vector<std::pair<std::string, std::string>> refused{
      {"c = { type = \"cfm\", between = [\"b\", \"ground\"], stiffness = 10, damping = 1, coulomb = 1 }", "the law of `c` (cfm) is not linear"},
      {"c = { type = \"sfm\", between = [\"b\", \"ground\"], stiffness = 10, coulomb = 1, exponent = 1 }", "the law of `c` (sfm) is not linear"},
      {"c = { type = \"dashpot\", between = [\"b\", \"ground\"], damping = 1, flow_index = 0.5 }", "the law of `c` (dashpot) is not linear"},
      {"c = { type = \"vfm\", between = [\"b\", \"ground\"], stiffness = 10, damping = 1, delay = 0.1 }", "the law of `c` (vfm) is not linear"},
      {"c = { type = \"force\", at = \"b\", force = { chirp = 1, frequency = 1, end_frequency = 2, duration = 1 } }", "the signal of `c` is a chirp"},
      {"c = { type = \"force\", at = \"b\", force = { table = [[0, 0], [1, 2], [2, 1]], smooth = true } }", "the signal of `c` is a smooth table"},
      {"c = { type = \"function\", in = \"b.position\", out = \"u1^3\" }", "`c` computes `u1^3`"},
  };
  for (const auto& [element, reason] : refused) {
    CAPTURE(element);
    const std::string toml = by_arcs(mass + element, 0.1);
    const std::string message = refusal(toml);
    CHECK_MESSAGE(message.find("`method = \"exact\"` needs laws that are linear between events, but " + reason) != std::string::npos, message);
    Scene scene = scene_of(toml);
    CHECK_THROWS_AS(check(scene), SimulationError);
    scene.method = Scene::Method::ida;
    Summary summary;
    simulate(scene, &summary);
    CHECK_EQ(summary.arc_steps, 0);
  }
  CHECK(refusal("[elements]\n" + mass + "[simulate]\nstop = 1\nmethod = \"arcs\"").find("`method` must be `auto`, `ida` or `exact`, but is `arcs`") != std::string::npos);
}

TEST_CASE("what oscillates too often for exact arcs is left to IDA") {
  const std::string toml = R"([elements]
m = { type = "mass", at = "b", mass = 1e-9 }
k = { type = "spring", between = ["b", "ground"], stiffness = 1e18 }
push = { type = "force", at = "b", force = { sine = 1e6, frequency = 0.1 } }
[simulate]
method = "exact"
stop = 100
)";
  Summary summary;
  const RunTable rows = simulate(scene_of(toml), &summary);
  CHECK_EQ(summary.arc_steps, 0);
  CHECK_LE(error_of(rows, "k.force", [](double t) { return 1e6 * std::sin(0.2 * M_PI * t); }), 1e-6);
}

TEST_CASE("a row at which a slider comes to rest and an input jumps is that after the jump") {
  // The force is gone and back again while the mass stands: it comes to rest at 1 s, as m v = F t.
  const RunTable rows = simulate(by_arcs(R"(m = { type = "mass", at = "b", mass = 1 }
f = { type = "slider", between = ["b", "ground"], coulomb = 1 }
push = { type = "force", at = "b", force = { table = [[0, 0], [1, 0], [1, 0.5], [2, 0.5]] } })", 2, "[nodes]\nb = { velocity = 1 }\n"));
  CHECK_EQ(rows.time()[100], 1);
  CHECK_EQ(rows["push.force"][100], 0.5);
}

}  // namespace rheonet::test::exact_arc_test
