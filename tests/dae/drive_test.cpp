#include "core/dae/drive.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/random.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

/// A drive of two nodes, and what it is made of.
struct Driven {
  Scene scene;
  Network network;
  Drive drive;

  Driven(const SceneBuilder& builder, double start, const std::vector<double>& positions)
      : scene(builder.finish(1, 10, 1e-6)),
        network(build_network(scene)),
        drive(network, start, before(network, start, positions)) {}
  Driven(const Driven&) = delete;

  /// Nodes that a position drives have followed it so far.
  static std::vector<double> before(const Network& network, double start, std::vector<double> positions) {
    for (const Network::Motion& m : network.motions) {
      if (m.position) positions[static_cast<std::size_t>(m.node)] = m.signal.before(start);
    }
    return positions;
  }

  double relative_velocity(int a, int b, double t) {
    drive.evaluate(t);
    const auto v = [&](int i) { return i < 0 ? 0 : drive.velocity[static_cast<std::size_t>(i)]; };
    return v(a) - v(b);
  }
};

SceneBuilder two_motions(const Signal& a, bool a_by_position, const Signal& b, bool b_by_position) {
  SceneBuilder builder;
  builder.motion("one", "a", a_by_position ? "position" : "velocity", a);
  builder.motion("two", "b", b_by_position ? "position" : "velocity", b);
  return builder;
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Where the velocity changes its sign, by trying: `samples` instants, then bisection. Touches are none.
std::vector<double> reversals_by_trying(Driven& driven, int a, int b, double t, double limit, int samples) {
  std::vector<double> found;
  double side = 0, last = t;
  for (int k = 0; k <= samples; ++k) {
    const double now = t + (limit - t) * k / samples;
    const double s = sign(driven.relative_velocity(a, b, now));
    if (s != 0 && side != 0 && s != side) {
      double low = last, high = now;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = (low + high) / 2;
        (sign(driven.relative_velocity(a, b, middle)) == s ? high : low) = middle;
      }
      found.push_back(high);
    }
    if (s != 0) side = s, last = now;
  }
  return found;
}

std::vector<double> reversals(Driven& driven, int a, int b, double t, double limit) {
  std::vector<double> found;
  for (double next = t; found.size() < 1000;) {
    next = driven.drive.next_reversal(a, b, next, limit);
    if (next == infinity) break;
    found.push_back(next);
  }
  return found;
}

Signal smooth(int kind, double scale, Random& random) {
  const double a = scale * random.uniform(-1, 1), frequency = random.uniform(0.3, 5), phase = random.uniform(0, 2 * pi);
  switch (kind) {
    case 0:
      return Signal(Signal::Constant{a});
    case 1:
      return Signal(Signal::Ramp{a, random.uniform(-0.5, 0), random.uniform(-1, 1) * scale});
    case 2:
      return Signal(Signal::Sine{a, frequency, phase, random.uniform(-0.3, 0), 0.3 * scale * random.uniform(-1, 1)});
    default:
      return Signal(
          Signal::Chirp{a, frequency, random.uniform(0.3, 9), 3.7, phase, 0, 0.2 * scale * random.uniform(-1, 1)});
  }
}

}  // namespace

TEST_CASE("reversals of a branch between two given motions: all of them, for generated pairs") {
  constexpr double limit = 2.31;
  int total = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool a_by_position = random.below(2) == 0, b_by_position = random.below(2) == 0;
    const Signal a = smooth(random.below(4), a_by_position ? 0.1 : 1, random),
                 b = smooth(random.below(4), b_by_position ? 0.1 : 1, random);
    Driven driven(two_motions(a, a_by_position, b, b_by_position), 0, {0, 0, 0});
    driven.drive.enter(0);
    const int second = random.below(3) == 0 ? -1 : 1;
    const std::vector<double> expected = reversals_by_trying(driven, 0, second, 0, limit, 3000);
    const std::vector<double> found = reversals(driven, 0, second, 0, limit);
    REQUIRE_EQ(found.size(), expected.size());
    total += static_cast<int>(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(std::abs(found[k] - expected[k]) < 1e-10);
  }
  CHECK(total > 1000);
}

TEST_CASE("a velocity that touches zero does not reverse; one that just crosses it does, twice") {
  constexpr double frequency = 1.7, amplitude = 0.41;
  for (const double side : {1.0, -1.0}) {
    for (const double excess : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
      for (const bool crosses : {true, false}) {
        CAPTURE(excess);
        CAPTURE(crosses);
        // amplitude (1 +- excess + sin): its lowest point is -+ excess amplitude.
        const double level = side * amplitude * (crosses ? 1 - excess : 1 + excess);
        Driven driven(two_motions(Signal(Signal::Sine{amplitude, frequency, 0.3, 0, level}), false, Signal(), true), 0,
                      {0, 0, 0});
        driven.drive.enter(0);
        const std::vector<double> found = reversals(driven, 0, 1, 0, 0.9 / frequency);
        REQUIRE_EQ(found.size(), crosses ? 2 : 0);
        if (!crosses) continue;
        // side + sin(angle) = side excess
        const double lowest = ((side > 0 ? 1.5 : 0.5) * pi - 0.3) / (2 * pi * frequency);
        const double half = std::acos(1 - excess) / (2 * pi * frequency);
        CHECK(std::abs(found[0] - (lowest - half)) < 1e-16 / half + 1e-12);
        CHECK(std::abs(found[1] - (lowest + half)) < 1e-16 / half + 1e-12);
      }
    }
  }
}

TEST_CASE("two equal motions do not reverse against each other, nor does one at rest") {
  const Signal sine(Signal::Sine{0.7, 2.3, 0.4, 0, 0.1});
  Driven driven(two_motions(sine, false, sine, false), 0, {0, 0, 0});
  driven.drive.enter(0);
  CHECK_EQ(driven.drive.next_reversal(0, 1, 0, 3.1), infinity);
  CHECK(driven.drive.next_reversal(0, -1, 0, 3.1) < 0.5);

  Driven rest(two_motions(Signal(), true, Signal(), false), 0, {0, 0, 0});
  rest.drive.enter(0);
  CHECK_EQ(rest.drive.next_reversal(0, 1, 0, 3.1), infinity);
  CHECK_EQ(rest.drive.next_reversal(0, -1, 0.5, 0.5), infinity);
  CHECK_EQ(rest.drive.next_reversal(0, -1, 0.5, infinity), infinity);
}

TEST_CASE("a reversal at which one stands is not the next one") {
  constexpr double frequency = 1.3;
  Driven driven(two_motions(Signal(Signal::Sine{0.7, frequency, 0, 0, 0}), false, Signal(), true), 0, {0, 0, 0});
  driven.drive.enter(0);
  CHECK_EQ(driven.drive.next_reversal(0, -1, 0, 2), doctest::Approx(0.5 / frequency).epsilon(1e-12));
  const double first = driven.drive.next_reversal(0, -1, 0, 2);
  CHECK_EQ(driven.drive.next_reversal(0, -1, first, 2), doctest::Approx(1 / frequency).epsilon(1e-12));
  CHECK_EQ(driven.drive.next_reversal(0, -1, 0, 0.4999 / frequency), infinity);
}

// What is remembered of one search must serve the next ones, over instants at which nothing changes and over those at
// which the signals do.
TEST_CASE("the next reversal is the same whatever was asked before") {
  int asked = 0, finite = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    SceneBuilder builder;
    builder.motion("smooth", "a", "velocity", smooth(2 + random.below(2), 1, random));
    builder.motion("edges", "b", "velocity",
                   Signal(Signal::Square{random.uniform(0.1, 1), random.uniform(0.5, 4), 0.3, 0, 0}));
    builder.motion("corners", "c", "position", Signal(Signal::Triangle{0.1, random.uniform(0.5, 4), 1.1, 0, 0}));
    builder.motion("one way", "d", "velocity", Signal(Signal::Sine{0.3, 3.1, 0.2, 0, 0.9}));
    const std::pair<int, int> pairs[] = {{0, -1}, {1, 0}, {-1, 3}, {2, 3}, {2, 0}, {3, 1}};
    constexpr double stop = 2.7;
    Driven driven(builder, 0, {0, 0, 0, 0, 0});
    for (double t = 0; t < stop;) {
      CAPTURE(t);
      driven.drive.enter(t);
      Driven fresh(builder, 0, {0, 0, 0, 0, 0});
      fresh.drive.enter(t);
      const double limit = std::min(driven.drive.next_break(), stop);
      double next = limit;
      for (const auto& [a, b] : pairs) {
        const double expected = fresh.drive.next_reversal(a, b, t, limit);
        const double found = driven.drive.next_reversal(a, b, t, limit);
        ++asked;
        if (std::isfinite(expected)) {
          ++finite;
          CHECK(std::abs(found - expected) < 1e-12);
        } else {
          CHECK_EQ(found, expected);
        }
        next = std::min(next, found);
      }
      // With one limit throughout, only the stretches tell that the signals have changed.
      const double far = fresh.drive.next_reversal(0, 1, t, stop), again = driven.drive.next_reversal(0, 1, t, stop);
      CHECK((std::isfinite(far) ? std::abs(again - far) < 1e-12 : again == far));
      // Also between reversals, as events of other laws would have it, and with a nearer limit.
      const double between = t + (next - t) * random.uniform(0.1, 0.9);
      const double nearer = driven.drive.next_reversal(0, -1, between, between + 0.01);
      CHECK((nearer == infinity || (nearer > between && nearer <= between + 0.01)));
      t = random.below(3) == 0 ? between : next;
    }
  }
  CHECK(finite > 1000);
  CHECK(finite < asked - 1000);
}

// A corner was taken for a step of the size of its rounding, which grows with speed, with angle and with time.
TEST_CASE("corners are no steps, however fast, wound up or late; the smallest real step is one") {
  const auto largest_step = [](const Signal& signal, double start, double stop, double& rounding) {
    SceneBuilder b;
    b.motion("m", "a", "position", signal);
    Driven driven(b, start, {0, 0});
    driven.drive.enter(start);
    double largest = 0;
    int breaks = 0;
    for (double t = driven.drive.next_break(); t < stop && breaks < 3000; t = driven.drive.next_break(), ++breaks) {
      rounding = std::max(rounding, std::abs(signal.value(t) - signal.before(t)));
      driven.drive.enter(t);
      largest = std::max(largest, std::abs(driven.drive.steps()[0]));
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
    const auto drive = [&](double start) {
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
    Driven first(drive(0), 0, positions), then(drive(late), late, positions);
    first.drive.enter(0);
    then.drive.enter(late);
    for (int k = 0; k < 2000; ++k) {
      const double t = static_cast<double>(k * 1021) * grain;
      // Edges of periods that are no multiples of the grain of time come earlier or later by that much.
      for (double next = first.drive.next_break(); next <= t; next = first.drive.next_break()) first.drive.enter(next);
      for (double next = then.drive.next_break(); next <= late + t; next = then.drive.next_break())
        then.drive.enter(next);
      if (first.drive.next_break() < t + 1e-6 || then.drive.next_break() < late + t + 1e-6) continue;
      first.drive.evaluate(t);
      then.drive.evaluate(late + t);
      for (std::size_t i = 0; i < 12; ++i) {
        CAPTURE(i);
        // Edges and corners (of the square and the triangle) are late by half the grain of time there, 1.5e-8 s.
        const bool exact = i % 6 != 2 && i % 6 != 3;
        const double value = exact ? 1e-13 : 1e-8 * 4 * f * a, rate = exact ? 1e-11 : 1e-8 * 4 * f * a;
        CHECK(std::abs(then.drive.position[i] - first.drive.position[i]) <= value);
        CHECK(std::abs(then.drive.velocity[i] - first.drive.velocity[i]) <= rate);
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
  Drive& d = driven.drive;

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
  driven.drive.enter(0);
  CHECK_EQ(driven.drive.steps()[0], doctest::Approx(0.31).epsilon(1e-14));
  CHECK_EQ(driven.drive.steps()[1], 0);
}

TEST_CASE("velocities and accelerations of a drive are the derivatives of its positions") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool by_position = seed % 2 == 0;
    const Signal a = smooth(1 + random.below(3), 0.3, random);
    Driven driven(two_motions(a, by_position, Signal(), true), 0, {0, 0.9, 0});
    Drive& d = driven.drive;
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
  slow.drive.enter(0);
  CHECK_EQ(slow.drive.fastest(), 0);
  Driven fast(
      two_motions(Signal(Signal::Sine{0.2, 1.3, 0, 0, 0}), false, Signal(Signal::Sine{0.1, 2.9, 0, 0, 0}), true), 0,
      {0, 0, 0});
  fast.drive.enter(0);
  CHECK_EQ(fast.drive.fastest(), doctest::Approx(2 * pi * 2.9).epsilon(1e-14));
}

}  // namespace rheonet::test
