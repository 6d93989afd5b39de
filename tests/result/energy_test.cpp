// The energy account where every motion is given: no step of an integrator is short enough by itself.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tests/support/scene_builder.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::energy_test {

namespace {

constexpr double frequency = 2.7, omega = 2 * std::numbers::pi * frequency, A = 0.023, stop = 3.31, accuracy = 1e-6;
const Signal sine(Signal::Sine{A, frequency, 0, 0, 0});

Summary summary_of(const SceneBuilder& b) {
  Summary summary;
  simulate(b.finish(stop, 10, accuracy), &summary);
  return summary;
}

doctest::Approx about(double value) { return doctest::Approx(value).epsilon(10 * accuracy); }

double at_stop() { return A * omega * std::cos(omega * stop); }

}  // namespace

TEST_CASE("energy of a dashpot between prescribed nodes") {
  constexpr double B = 3.7;
  SceneBuilder b;
  b.motion("drive", "a", "position", sine);
  b.between("c", "dashpot", "ground", "a", {{"damping", B}});
  const Summary s = summary_of(b);
  const double heat = B * A * A * omega * omega * (stop / 2 + std::sin(2 * omega * stop) / (4 * omega));
  CHECK_EQ(s.dissipated, about(heat));
  CHECK_EQ(s.supplied, about(heat));
  CHECK_EQ(s.stored, 0);
}

TEST_CASE("energy of a mass on a prescribed node") {
  constexpr double m = 0.83;
  SceneBuilder b;
  b.motion("drive", "a", "position", sine);
  b.at("m", "mass", "a", {{"mass", m}});
  const Summary s = summary_of(b);
  const double gained = m / 2 * (at_stop() * at_stop() - A * A * omega * omega);
  CHECK_EQ(s.stored, about(gained));
  CHECK_EQ(s.supplied, about(gained));
  CHECK_EQ(s.dissipated, 0);
}

TEST_CASE("energy of a given force on a prescribed node: the motion takes what the force gives") {
  constexpr double F = 1.9;
  SceneBuilder b;
  b.motion("drive", "a", "position", sine);
  b.force("push", "a", Signal(Signal::Constant{F}));
  b.between("k", "spring", "a", "ground", {{"stiffness", 71.3}});
  const Summary s = summary_of(b);
  const double x = A * std::sin(omega * stop);
  CHECK_EQ(s.stored, about(71.3 * x * x / 2));
  CHECK_EQ(s.supplied, about(71.3 * x * x / 2));
}

TEST_CASE("energy of friction between prescribed nodes: a loop a cycle") {
  // Prandtl's law: 4 Fc (A - Fc/sigma) a cycle, once it slides; a quarter of a cycle goes before.
  constexpr double sigma = 413.0, Fc = 1.7, cycles = 8;
  SceneBuilder b;
  b.motion("drive", "a", "position", sine);
  b.between("f", "sfm", "a", "ground", {{"stiffness", sigma}, {"coulomb", Fc}, {"exponent", 0}});
  Summary s;
  simulate(b.finish((cycles + 0.25) / frequency, 10, accuracy), &s);
  const double first = Fc * (A - Fc / sigma), loop = 4 * Fc * (A - Fc / sigma);
  CHECK_EQ(s.dissipated, about(first + cycles * loop));
  CHECK_EQ(s.stored, about(Fc * Fc / (2 * sigma)));
  CHECK_EQ(s.supplied, about(first + cycles * loop + Fc * Fc / (2 * sigma)));
}

TEST_CASE("supplied power agrees with the recorded forces and velocities") {
  SceneBuilder b;
  b.motion("drive", "a", "velocity", Signal(Signal::Chirp{0.37, 0.9, 3.1, 1, 0.6, 0, 0.1}));
  b.between("k", "spring", "a", "b", {{"stiffness", 91.0}});
  b.at("m", "mass", "b", {{"mass", 0.53}});
  b.between("c", "dashpot", "ground", "b", {{"damping", 1.7}});
  b.force("push", "b", Signal(Signal::Sine{2.3, 1.3, 0.2, 0, 0}));
  b.start("b", -0.04, 0.3);
  Summary s;
  constexpr int intervals = 1000;
  const RunTable run = simulate(b.finish(1, intervals, 1e-8), &s);
  double supplied = 0, dissipated = 0;  // by Simpson's rule over the rows
  for (std::size_t row = 0; row <= intervals; ++row) {
    const double weight = (row == 0 || row == intervals ? 1 : row % 2 ? 4 : 2) / (3.0 * intervals);
    supplied +=
        weight * (run["drive.force"][row] * run["a.velocity"][row] + run["push.force"][row] * run["b.velocity"][row]);
    dissipated += weight * run["c.force"][row] * run["c.velocity"][row];
  }
  CHECK_EQ(s.supplied, doctest::Approx(supplied).epsilon(1e-7));
  CHECK_EQ(s.dissipated, doctest::Approx(dissipated).epsilon(1e-7));
  const auto energy = [&](std::size_t row) {
    return 91.0 / 2 * std::pow(run["k.displacement"][row], 2) + 0.53 / 2 * std::pow(run["b.velocity"][row], 2);
  };
  CHECK_EQ(s.stored, doctest::Approx(energy(intervals) - energy(0)).epsilon(1e-7));
}

}  // namespace rheonet::test::energy_test
