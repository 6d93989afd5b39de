// Many sliders: a chain of masses joined by sliders to each other and to the ground, shaken so that parts of it lock
// and break; and many that break away at the same instant.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/network/component.hpp"
#include "tests/analytic/slider_checks.hpp"

namespace rheonet::test::slider_chain_test {

namespace {

constexpr int N = 200;
constexpr double amplitude = 7.5, frequency = 3.7, stop = 1.13;

/// The joints are the weaker the farther from the push at the end, though not evenly: some ten of them slip at a time,
/// and the rest of the chain goes in clusters.
std::string shaken(double sign) {
  return fmt::format(R"toml(
[models.cell]
ports = ["a", "b"]
parameters = ["joint", "floor", "m"]
[models.cell.elements]
joint = {{ type = "slider", between = ["a", "b"], coulomb = "joint" }}
mass  = {{ type = "mass", at = "b", mass = "m" }}
floor = {{ type = "slider", between = ["b", "ground"], coulomb = "floor" }}

[elements]
push = {{ type = "force", at = "end", force = {{ sine = {:.17g}, frequency = {:.17g}, phase = 0.3 }} }}

[elements.chain]
type = "cell"
between = ["ground", "end"]
joint = "0.5 + 0.03*i + 0.03*sin(2.3*i)"
floor = "0.01 + 0.0055*cos(1.7*i)"
m = "0.0173 + 0.0071*sin(0.9*i)"
repeat = {{ count = {}, as = "i" }}

[simulate]
stop = {:.17g}
output = {{ points = 227 }}
)toml",
                     sign * amplitude, frequency, N, stop);
}

/// The events in the rows of a run.
struct Told {
  long sticking = 0, slipping = 0, changes = 0, locked = 0;
};

/// Checks in each row that every slider obeys its law: its force is within its bounds, and where it is not at a
/// standstill exactly what it slips at.
Told check_laws(const Scene& scene, const RunTable& rows, double accuracy) {
  Told told;
  for (const SceneElement& e : scene.elements) {
    if (declarations()[std::size_t(e.declaration)]->type != "slider") continue;
    CAPTURE(e.name);
    const double coulomb = e.values[0];
    const std::vector<double>&f = rows[e.name + ".force"], &w = rows[e.name + ".velocity"];
    const double noise = 10 * accuracy * rows.scale(e.name + ".velocity");
    bool lawful = true;
    for (std::size_t row = 0; row < f.size(); ++row) {
      lawful = lawful && std::abs(f[row]) <= coulomb;
      if (w[row] != 0)
        lawful = lawful && std::abs(f[row]) == coulomb && (std::abs(w[row]) <= noise || w[row] * f[row] > 0);
      ++(w[row] == 0 ? told.sticking : told.slipping);
      if (row > 0 && (w[row] == 0) != (w[row - 1] == 0)) ++told.changes;
      if (e.b != ground && w[row] == 0 && rows[scene.nodes[std::size_t(e.b)].name + ".velocity"][row] != 0)
        ++told.locked;
    }
    CHECK(lawful);
  }
  return told;
}

/// The sum of the forces at every node, in every row, against the largest applied.
double imbalance(const Scene& scene, const RunTable& rows) {
  std::vector<std::vector<double>> sum(scene.nodes.size(), std::vector<double>(rows.time().size(), 0));
  for (const SceneElement& e : scene.elements) {
    const std::vector<double>& f = rows[e.name + ".force"];
    const double sign = declarations()[std::size_t(e.declaration)]->type == "force" ? -1 : 1;
    for (std::size_t row = 0; row < f.size(); ++row) {
      sum[std::size_t(e.a)][row] += sign * f[row];
      if (!e.at) sum[std::size_t(e.b)][row] -= sign * f[row];
    }
  }
  double worst = 0;
  for (std::size_t n = 1; n < sum.size(); ++n) {
    for (const double x : sum[n]) worst = std::max(worst, std::isnan(x) ? HUGE_VAL : std::abs(x));
  }
  return worst;
}

}  // namespace

TEST_CASE("A chain of 200 masses joined by sliders, shaken: laws, balance, energy, symmetry") {
  for (const double accuracy : {1e-3, 1e-6}) {
    CAPTURE(accuracy);
    const Scene scene = scene_of(shaken(1), accuracy), mirrored = scene_of(shaken(-1), accuracy);
    Summary summary;
    const RunTable rows = simulate(scene, &summary), other = simulate(mirrored);
    REQUIRE_EQ(rows.time().size(), 227);
    for (const std::string& name : rows.header) {
      for (const double x : rows[name]) {
        if (!std::isfinite(x)) FAIL_CHECK(name);
      }
    }
    const Told told = check_laws(scene, rows, accuracy);
    // It is what it should be: parts stick to each other and move, and that changes often.
    CHECK_GT(told.changes, N / 2);
    CHECK_GT(told.locked, 10 * N);
    CHECK_GT(told.slipping, 10 * N);
    CHECK_LE(imbalance(scene, rows), 10 * accuracy * amplitude);
    CHECK_GT(summary.dissipated, 0.1 * summary.supplied);
    CHECK_LE(std::abs(summary.missing), 10 * accuracy * summary.largest);

    // Two solutions, each as good as the accuracy. Forces jump; positions and velocities do not.
    for (const char* channel : {".position", ".velocity"}) {
      for (std::size_t n = 1; n < scene.nodes.size(); ++n) {
        const std::string name = scene.nodes[n].name + channel;
        double worst = 0;
        for (std::size_t row = 0; row < rows.time().size(); ++row) {
          worst = std::max(worst, std::abs(rows[name][row] + other[name][row]));
        }
        CHECK_MESSAGE(worst <= 20 * accuracy * rows.scale(name), fmt::format("{}: {:.3g}", name, worst));
      }
    }
  }
}

// A mass alone would do the same: the springs between them never stretch.
TEST_CASE("200 sliders that break away at the same instant") {
  const double m = 0.0713, Fc = 0.83, slope = 3.13, end = 0.713;
  for (const double Fs : {Fc, 1.43 * Fc}) {
    CAPTURE(Fs);
    const double breaks = Fs / slope, excess = Fs - Fc;
    const std::string toml = fmt::format(R"(
[models.cell]
ports = ["a", "b"]
[models.cell.elements]
spring = {{ type = "spring", between = ["a", "b"], stiffness = 37.1 }}
mass   = {{ type = "mass", at = "b", mass = {0:.17g} }}
slider = {{ type = "slider", between = ["b", "ground"], coulomb = {1:.17g}, breakaway = {2:.17g} }}
push   = {{ type = "force", at = "b", force = {{ ramp = {3:.17g} }} }}

[elements]
mass   = {{ type = "mass", at = "head", mass = {0:.17g} }}
slider = {{ type = "slider", between = ["head", "ground"], coulomb = {1:.17g}, breakaway = {2:.17g} }}
push   = {{ type = "force", at = "head", force = {{ ramp = {3:.17g} }} }}

[elements.chain]
type = "cell"
between = ["head", "tail"]
repeat = {{ count = {4} }}

[simulate]
stop = {5:.17g}
output = {{ points = 101 }}
)",
                                         m, Fc, Fs, slope, N - 1, end);
    const auto velocity = from(breaks, [=](double t) { return (excess * t + slope * t * t / 2) / m; });
    const auto position = from(breaks, [=](double t) { return (excess * t * t / 2 + slope * t * t * t / 6) / m; });
    Expectations expected;
    for (const char* node : {"head", "chain.node1", "chain.node77", "chain.node198", "tail"}) {
      expected.push_back({std::string(node) + ".velocity", velocity});
      expected.push_back({std::string(node) + ".position", position});
    }
    for (const char* spring : {"chain.0", "chain.77", "chain.198"}) {
      expected.push_back({std::string(spring) + ".spring.force", [](double) { return 0; }, Fc});
    }
    // At 1e-9 it takes some hundred thousand steps: springs that nothing stretches are followed to the roundings of the
    // velocities at their ends.
    for (const double accuracy : {1e-3, 1e-6}) {
      const RunTable rows = simulate(toml, accuracy);
      for (const Expectation& one : expected) check_against(rows, one, accuracy);
    }
    for (const double accuracy : {1e-3, 1e-6}) {
      const RunTable rows = simulate(toml, accuracy);
      for (std::size_t row = 0; row < rows.time().size(); ++row) {
        const double t = rows.time()[row];
        if (std::abs(t - breaks) <= accuracy * end) continue;
        for (const char* slider : {"slider.force", "chain.0.slider.force", "chain.198.slider.force"}) {
          CHECK_LE(std::abs(rows[slider][row] - (t < breaks ? slope * t : Fc)), 10 * accuracy * Fs);
        }
      }
    }
    // One instant: not 200 restarts.
    const Summary summary = outcome(toml, 1e-6).summary;
    CHECK_LE(summary.restarts, 10);
  }
}

}  // namespace rheonet::test::slider_chain_test
