#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/dae/driven.hpp"

namespace rheonet::test::reversals_test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

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
    next = driven.inputs.next_reversal(a, b, next, limit);
    if (next == infinity) break;
    found.push_back(next);
  }
  return found;
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
    driven.inputs.enter(0);
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
        driven.inputs.enter(0);
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
  driven.inputs.enter(0);
  CHECK_EQ(driven.inputs.next_reversal(0, 1, 0, 3.1), infinity);
  CHECK(driven.inputs.next_reversal(0, -1, 0, 3.1) < 0.5);

  Driven rest(two_motions(Signal(), true, Signal(), false), 0, {0, 0, 0});
  rest.inputs.enter(0);
  CHECK_EQ(rest.inputs.next_reversal(0, 1, 0, 3.1), infinity);
  CHECK_EQ(rest.inputs.next_reversal(0, -1, 0.5, 0.5), infinity);
  CHECK_EQ(rest.inputs.next_reversal(0, -1, 0.5, infinity), infinity);
}

TEST_CASE("a reversal at which one stands is not the next one") {
  constexpr double frequency = 1.3;
  Driven driven(two_motions(Signal(Signal::Sine{0.7, frequency, 0, 0, 0}), false, Signal(), true), 0, {0, 0, 0});
  driven.inputs.enter(0);
  CHECK_EQ(driven.inputs.next_reversal(0, -1, 0, 2), doctest::Approx(0.5 / frequency).epsilon(1e-12));
  const double first = driven.inputs.next_reversal(0, -1, 0, 2);
  CHECK_EQ(driven.inputs.next_reversal(0, -1, first, 2), doctest::Approx(1 / frequency).epsilon(1e-12));
  CHECK_EQ(driven.inputs.next_reversal(0, -1, 0, 0.4999 / frequency), infinity);
}

// The cached result of a search must be valid for later searches, across instants at which signals change and at which they do not.
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
      driven.inputs.enter(t);
      Driven fresh(builder, 0, {0, 0, 0, 0, 0});
      fresh.inputs.enter(t);
      const double limit = std::min(driven.inputs.next_break(), stop);
      double next = limit;
      for (const auto& [a, b] : pairs) {
        const double expected = fresh.inputs.next_reversal(a, b, t, limit);
        const double found = driven.inputs.next_reversal(a, b, t, limit);
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
      const double far = fresh.inputs.next_reversal(0, 1, t, stop), again = driven.inputs.next_reversal(0, 1, t, stop);
      CHECK((std::isfinite(far) ? std::abs(again - far) < 1e-12 : again == far));
      // Also between reversals, as events of other laws would have it, and with a nearer limit.
      const double between = t + (next - t) * random.uniform(0.1, 0.9);
      const double nearer = driven.inputs.next_reversal(0, -1, between, between + 0.01);
      CHECK((nearer == infinity || (nearer > between && nearer <= between + 0.01)));
      t = random.below(3) == 0 ? between : next;
    }
  }
  CHECK(finite > 1000);
  CHECK(finite < asked - 1000);
}

}  // namespace rheonet::test::reversals_test
