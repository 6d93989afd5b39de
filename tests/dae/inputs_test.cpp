#include "core/dae/inputs.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/dae/driven.hpp"

namespace rheonet::test::inputs_test {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

// A corner was taken for a step of the size of its rounding, which grows with speed, with angle and with time.
TEST_CASE("corners are no steps, however fast, wound up or late; the smallest real step is one") {
  const auto largest_step = [](const Signal& signal, double start, double stop, double& rounding) {
    SceneBuilder b;
    b.motion("m", "a", "position", signal);
    Driven driven(b, start, {0, 0});
    driven.inputs.enter(start);
    double largest = 0;
    int breaks = 0;
    for (double t = driven.inputs.next_break(); t < stop && breaks < 3000; t = driven.inputs.next_break(), ++breaks) {
      rounding = std::max(rounding, std::abs(signal.value(t) - signal.before(t)));
      driven.inputs.enter(t);
      largest = std::max(largest, std::abs(driven.inputs.steps()[0]));
    }
    return largest;
  };
  double rounding = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double amplitude = std::pow(10, random.uniform(-6, 1)), frequency = std::pow(10, random.uniform(-1, 5));
    const double start = random.below(2) * std::pow(10, random.uniform(0, 8)),
                 offset = amplitude * random.uniform(-1, 1);
    const double phase = random.uniform(-90, 90), began = start * random.below(2), duration = 3000 / frequency;
    CHECK_EQ(largest_step(Signal(Signal::Triangle{amplitude, frequency, phase, began, offset}), start, start + duration,
                          rounding),
             0);
    const double end_frequency = frequency * random.uniform(0, 30);
    const double before = began - duration * random.uniform(0.1, 0.9);
    CHECK_EQ(largest_step(Signal(Signal::Chirp{amplitude, frequency, end_frequency, duration, phase, before, offset}),
                          start, start + duration, rounding),
             0);
    std::vector<double> times, values;
    for (int k = 0; k < 50; ++k) {
      times.push_back((k == 0 ? 0 : times.back()) + random.uniform(0, 2 / frequency));
      values.push_back(amplitude * random.uniform(-1, 1));
    }
    CHECK_EQ(largest_step(Signal(Signal::Table{times, values, before, offset}), start, start + duration, rounding), 0);
  }
  CHECK(rounding > 0);  // else nothing was tested

  double ignored = 0;
  for (const double height : {1e-12, -1e-12, 1e-6}) {
    const Signal steep(Signal::Table{{0, 1, 1, 2}, {1, 0.5, 0.5 + height, 1}, 0.1, 0.2});
    CHECK(largest_step(steep, 0.2, 2, ignored) == doctest::Approx(std::abs(height)).epsilon(1e-3));
  }
}

// Far from time 0 the time itself has fewer digits, but of a signal that begins there nothing more is lost: what counts
// is the distance from its beginning. Times are such that both are exact.
TEST_CASE("a drive that begins late is as exact as one that begins at 0") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    constexpr double late = 1e8, grain = 1.0 / (1 << 20);
    const double a = random.uniform(0.1, 1), f = random.uniform(0.3, 50), phase = random.uniform(-9, 9), offset = 0.3;
    const auto inputs = [&](double start) {
      SceneBuilder b;
      for (const char* parameter : {"position", "velocity"}) {
        const auto motion = [&](const std::string& name, const Signal& signal) {
          b.motion(name + parameter, "node_" + name + parameter, parameter, signal);
        };
        motion("ramp", Signal(Signal::Ramp{a, start, offset}));
        motion("sine", Signal(Signal::Sine{a, f, phase, start, offset}));
        motion("square", Signal(Signal::Square{a, f, phase, start, offset}));
        motion("triangle", Signal(Signal::Triangle{a, f, phase, start, offset}));
        motion("chirp", Signal(Signal::Chirp{a, f, 3 * f, 1.5, phase, start, offset}));
        motion("table", Signal(Signal::Table{{0.25, 1, 1.75}, {a, 0, -a}, start, offset}));
      }
      return b;
    };
    const std::vector<double> positions(13, 0.0);
    Driven first(inputs(0), 0, positions), then(inputs(late), late, positions);
    first.inputs.enter(0);
    then.inputs.enter(late);
    for (int k = 0; k < 2000; ++k) {
      const double t = static_cast<double>(k * 1021) * grain;
      // Edges of periods that are no multiples of the grain of time come earlier or later by that much.
      for (double next = first.inputs.next_break(); next <= t; next = first.inputs.next_break()) first.inputs.enter(next);
      for (double next = then.inputs.next_break(); next <= late + t; next = then.inputs.next_break())
        then.inputs.enter(next);
      if (first.inputs.next_break() < t + 1e-6 || then.inputs.next_break() < late + t + 1e-6) continue;
      first.inputs.evaluate(t);
      then.inputs.evaluate(late + t);
      for (std::size_t i = 0; i < 12; ++i) {
        CAPTURE(i);
        // Edges and corners (of the square and the triangle) are late by half the grain of time there, 1.5e-8 s.
        const bool exact = i % 6 != 2 && i % 6 != 3;
        const double value = exact ? 1e-13 : 1e-8 * 4 * f * a, rate = exact ? 1e-11 : 1e-8 * 4 * f * a;
        CHECK(std::abs(then.inputs.position[i] - first.inputs.position[i]) <= value);
        CHECK(std::abs(then.inputs.velocity[i] - first.inputs.velocity[i]) <= rate);
      }
    }
  }
}

TEST_CASE("a drive goes over jumps and corners: what steps, what goes on, when the next one comes") {
  SceneBuilder b;
  b.motion("by position", "a", "position", Signal(Signal::Step{0.037, 0.31, 0.013}));
  b.motion("by velocity", "b", "velocity", Signal(Signal::Square{0.7, 0.9, 0, 0.11, 0.05}));
  b.motion("corner", "c", "position", Signal(Signal::Triangle{0.19, 1.1, 0, 0.07, 0}));
  b.force("push", "c", Signal(Signal::Pulse{2.3, 0.29, 0, 0, 0.17, 0.4}));
  Driven driven(b, 0, {0, 99, 1.7, 99});
  Inputs& d = driven.inputs;

  // Before the first `enter` all rests where it was before the run.
  d.evaluate(0);
  CHECK_EQ(d.position[0], 0.013);
  CHECK_EQ(d.position[1], 1.7);
  CHECK_EQ(d.velocity[1], 0);

  d.enter(0);
  CHECK_EQ(d.steps()[0], 0);
  CHECK_EQ(d.next_break(), 0.07);
  d.evaluate(0.06);
  CHECK_EQ(d.velocity[1], 0.05);
  CHECK_EQ(d.position[1], doctest::Approx(1.7 + 0.05 * 0.06).epsilon(1e-14));
  CHECK_EQ(d.velocity[2], 0);
  CHECK_EQ(d.force[0], 0.4);

  d.enter(0.07);
  CHECK_EQ(d.steps()[2], 0);  // a corner is no step
  d.evaluate(0.1);
  CHECK_EQ(d.velocity[2], doctest::Approx(0.19 * 4 * 1.1).epsilon(1e-14));
  CHECK_EQ(d.next_break(), 0.11);
  d.enter(0.11);
  CHECK_EQ(d.next_break(), 0.17);
  d.enter(0.17);
  d.evaluate(0.18);
  CHECK_EQ(d.force[0], doctest::Approx(2.7).epsilon(1e-14));
  CHECK_EQ(d.force_rate[0], 0);
  CHECK_EQ(d.position[1], doctest::Approx(1.7 + 0.05 * 0.18 + 0.7 * 0.07).epsilon(1e-14));

  CHECK_EQ(d.next_break(), doctest::Approx(0.07 + 0.25 / 1.1).epsilon(1e-14));
  d.enter(d.next_break());
  d.enter(0.31);
  CHECK_EQ(d.steps()[0], doctest::Approx(0.037).epsilon(1e-14));
  CHECK_EQ(d.steps()[1], 0);
  d.evaluate(0.31);
  CHECK_EQ(d.position[0], doctest::Approx(0.05).epsilon(1e-14));
  CHECK_EQ(d.velocity[0], 0);
  d.enter(0.32);
  CHECK_EQ(d.steps()[0], 0);
}

TEST_CASE("a drive that begins with its value already there has stepped from before the run") {
  SceneBuilder b;
  b.motion("cosine", "a", "position", Signal(Signal::Sine{0.31, 1.9, pi / 2, 0, 0}));
  b.motion("earlier", "b", "position", Signal(Signal::Step{0.7, -0.4, 0}));
  Driven driven(b, 0, {0, 0, 0});
  driven.inputs.enter(0);
  CHECK_EQ(driven.inputs.steps()[0], doctest::Approx(0.31).epsilon(1e-14));
  CHECK_EQ(driven.inputs.steps()[1], 0);
}

TEST_CASE("velocities and accelerations of a drive are the derivatives of its positions") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool by_position = seed % 2 == 0;
    const Signal a = smooth(1 + random.below(3), 0.3, random);
    Driven driven(two_motions(a, by_position, Signal(), true), 0, {0, 0.9, 0});
    Inputs& d = driven.inputs;
    d.enter(0);
    const double t = random.uniform(0.2, 1), h = 1e-4;
    const auto at = [&](double when, const std::vector<double>& what) {
      d.evaluate(when);
      return what[0];
    };
    CHECK(std::abs((at(t + h, d.position) - at(t - h, d.position)) / (2 * h) - at(t, d.velocity)) < 1e-4);
    CHECK(std::abs((at(t + h, d.velocity) - at(t - h, d.velocity)) / (2 * h) - at(t, d.acceleration)) < 1e-2);
    if (!by_position) CHECK_EQ(at(0, d.position), 0.9);
  }
}

TEST_CASE("the fastest oscillation of a drive") {
  Driven slow(two_motions(Signal(Signal::Ramp{1.3, 0, 0}), false, Signal(), true), 0, {0, 0, 0});
  slow.inputs.enter(0);
  CHECK_EQ(slow.inputs.fastest(), 0);
  Driven fast(
      two_motions(Signal(Signal::Sine{0.2, 1.3, 0, 0, 0}), false, Signal(Signal::Sine{0.1, 2.9, 0, 0, 0}), true), 0,
      {0, 0, 0});
  fast.inputs.enter(0);
  CHECK_EQ(fast.inputs.fastest(), doctest::Approx(2 * pi * 2.9).epsilon(1e-14));
}

// The square of a speed of 1e298 m/s is beyond the numbers: strides became 0, and the search did not end.
TEST_CASE("reversals of a sine are found at any amplitude") {
  for (const double amplitude : {1e-300, 1e-160, 1e-12, 1.0, 1e12, 1e160, 1e297, 1e304}) {
    CAPTURE(amplitude);
    SceneBuilder b;
    b.motion("m", "a", "position", Signal(Signal::Sine{amplitude, 1, 0, 0, 0}));
    Driven driven(b, 0, {0, 0});
    driven.inputs.enter(0);
    CHECK(driven.inputs.next_reversal(0, -1, 0, 0.9) == doctest::Approx(0.25).epsilon(1e-12));
    CHECK(driven.inputs.next_reversal(0, -1, 0.3, 0.9) == doctest::Approx(0.75).epsilon(1e-12));
    CHECK(std::isinf(driven.inputs.next_reversal(0, -1, 0.3, 0.7)));
  }
  // Where the third derivative is beyond the numbers, there is an answer at once.
  SceneBuilder b;
  b.motion("m", "a", "position", Signal(Signal::Sine{1e307, 1, 0, 0, 0}));
  Driven driven(b, 0, {0, 0});
  driven.inputs.enter(0);
  CHECK(driven.inputs.next_reversal(0, -1, 0, 0.9) > 0.2);
}

}  // namespace rheonet::test::inputs_test
