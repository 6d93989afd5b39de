// The bundle law against a plain sum of N springs, each cut off at its slider's force.
#include "core/network/iwan.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rheonet::test::iwan_test {

namespace {

constexpr double rounding = 1e-12;

/// Pairs that know nothing of each other: f = clamp(f + k dp, -Fc, Fc) for every little step.
struct Plain {
  std::vector<Iwan::Pair> pairs;
  std::vector<double> force, slide;
  double p = 0, heat = 0;

  Plain(std::vector<Iwan::Pair> of, std::vector<double> start)
      : pairs(std::move(of)), force(std::move(start)), slide(pairs.size(), 0) {}

  void move(double to) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [k, Fc] = pairs[i];
      const double elastic = force[i] + k * (to - p), kept = std::clamp(elastic, -Fc, Fc);
      slide[i] += (elastic - kept) / k;
      heat += std::abs(elastic - kept) / k * Fc;
      force[i] = kept;
    }
    p = to;
  }
  double sum() const {
    double f = 0;
    for (double one : force) f += one;
    return f;
  }
  double stored() const {
    double e = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) e += force[i] * force[i] / (2 * pairs[i].stiffness);
    return e;
  }
  double scale() const {
    double f = 0;
    for (const Iwan::Pair& pair : pairs) f += pair.coulomb;
    return f;
  }
};

/// Uses a bundle as an integrator does: moves to each kink that is an event, and passes it.
void move(Iwan& bundle, double& p, double to, double& heat) {
  const int direction = to < p ? -1 : 1;
  if (direction != bundle.direction()) {
    bundle.turn(p);
  }
  while (bundle.to_kink(p) < std::abs(to - p)) {
    const double kink = p + direction * bundle.to_kink(p), before = bundle.heat(p);
    heat += bundle.heat(kink) - before;
    p = kink;
    double slope;
    const double force = bundle.force(p, slope);
    bundle.pass_kink(p);
    CHECK(std::abs(bundle.force(p, slope) - force) <= rounding * bundle.total_force());
  }
  heat += bundle.heat(to) - bundle.heat(p);
  p = to;
}

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double from, double to) { return std::uniform_real_distribution<double>(from, to)(generator_); }

 private:
  std::mt19937 generator_;
};

std::vector<Iwan::Pair> random_pairs(std::size_t n, Random& random) {
  std::vector<Iwan::Pair> pairs;
  for (std::size_t i = 0; i < n; ++i) pairs.push_back({std::exp(random(-2, 2)), std::exp(random(-2, 2))});
  // Some the same to the last digit: one kink.
  for (std::size_t i = 3; i < n; i += 7) pairs[i] = pairs[i - 3];
  return pairs;
}

}  // namespace

TEST_CASE("a bundle is the sum of its pairs, whatever the path and the forces at the start") {
  for (const std::size_t n : {1, 2, 3, 10, 100, 1000}) {
    for (const double share : {0.0, 0.03, 2.0}) {
      for (const bool loaded : {false, true}) {
        CAPTURE(n);
        CAPTURE(share);
        CAPTURE(loaded);
        Random random(static_cast<unsigned>(n) + 11);
        const std::vector<Iwan::Pair> pairs = random_pairs(n, random);
        std::vector<double> start(n, 0);
        for (std::size_t i = 0; loaded && i < n; ++i)
          start[i] = pairs[i].coulomb * std::clamp(random(-1.2, 1.2), -1.0, 1.0);
        Plain plain(pairs, start);
        Iwan bundle(pairs, share);
        bundle.begin(0, start, 1);
        double p = 0, heat = 0;
        const double scale = plain.scale();
        for (int k = 0; k < 60; ++k) {
          // Now and then on in the same direction; far, near, and back and forth by nothing.
          const double to = k % 9 == 8 ? p : p + random(-1, 1) * std::exp(random(-4, 2));
          const double ahead = random(-3, 3);
          double slope = 0;
          const double foreseen = bundle.force_along(p, to - p, slope);
          Plain trial = plain;
          trial.move(p + ahead);
          CHECK(std::abs(bundle.force_along(p, ahead, slope) - trial.sum()) <= rounding * scale);
          move(bundle, p, to, heat);
          plain.move(to);
          CHECK(std::abs(foreseen - plain.sum()) <= rounding * scale);
          CHECK(std::abs(bundle.force(p, slope) - plain.sum()) <= rounding * scale);
          CHECK(std::abs(bundle.stored_energy(p) - plain.stored()) <= rounding * plain.stored() + 1e-14);
          CHECK(std::abs(heat - plain.heat) <= rounding * (1 + plain.heat));
          double worst = 0, worst_slide = 0;
          for (std::size_t i = 0; i < n; ++i) {
            worst = std::max(worst, std::abs(bundle.pair_force(i, p) - plain.force[i]) / pairs[i].coulomb);
            worst_slide = std::max(worst_slide, std::abs(bundle.slide(i, p) - plain.slide[i]));
            CHECK(std::abs(bundle.pair_force(i, p)) <= pairs[i].coulomb);
          }
          CHECK(worst <= rounding * 100);
          CHECK(worst_slide <= rounding * 100);
        }
      }
    }
  }
}

TEST_CASE("slopes of a bundle to either side, and the order of its yields") {
  // Yields at 0.5 m, 1 m, 2 m from virgin; the middle one is more than half of the stiffness.
  Iwan bundle({{1, 2}, {4, 4}, {2, 1}}, 0.55);
  CHECK_EQ(bundle.slope(0, 1), 7);
  CHECK_EQ(bundle.slope(0, -1), 7);
  CHECK_EQ(bundle.slope(0.7, 1), 5);
  CHECK_EQ(bundle.slope(0.7, -1), 7);
  CHECK_EQ(bundle.yielded(0.7), 1);
  CHECK_EQ(bundle.in_order(0), 2);
  CHECK_EQ(bundle.yield_point(1), 1);
  // Up to the kink that is an event, and straight beyond it.
  double slope = 0;
  CHECK_EQ(bundle.to_kink(0.7), doctest::Approx(0.3));
  CHECK_EQ(bundle.force(1.1, slope), doctest::Approx(1 + 4.4 + 1.1));
  CHECK_EQ(slope, 5);
  bundle.pass_kink(1);
  CHECK_EQ(bundle.slope(1, 1), 1);
  CHECK_EQ(bundle.force(1.5, slope), doctest::Approx(1 + 4 + 1.5));
  CHECK(!bundle.all_yielded());
  CHECK_EQ(bundle.to_kink(1.5), doctest::Approx(0.5));
  bundle.pass_kink(2);
  CHECK(bundle.all_yielded());
  CHECK_EQ(bundle.force(7, slope), 7);
  CHECK_EQ(slope, 0);
  CHECK(std::isinf(bundle.to_kink(7)));
  // Turned at its bound: forwards from there it slides on, backwards all stick.
  bundle.turn(7);
  CHECK_EQ(bundle.direction(), -1);
  CHECK_EQ(bundle.slope(7, -1), 7);
  CHECK_EQ(bundle.slope(7, 1), 0);
  CHECK_EQ(bundle.to_kink(7), doctest::Approx(2));
}

TEST_CASE("inner loops close, and a larger loop wipes them out") {
  Random random(5);
  const std::vector<Iwan::Pair> pairs = random_pairs(50, random);
  const auto path = [&](const std::vector<double>& points) {
    Iwan bundle(pairs, 2);
    double p = 0, heat = 0, slope = 0;
    for (double to : points) move(bundle, p, to, heat);
    return bundle.force(p, slope);
  };
  CHECK_EQ(path({1.3, -0.7, 0.4, -0.2, 0.4}), doctest::Approx(path({1.3, -0.7, 0.4})).epsilon(1e-13));
  CHECK_EQ(path({1.3, -0.7, 0.4, -0.2, 0.9}), doctest::Approx(path({1.3, -0.7, 0.9})).epsilon(1e-13));
  CHECK_EQ(path({1.3, -0.7, 0.4, -0.2, 2.1}), doctest::Approx(path({2.1})).epsilon(1e-13));
}

TEST_CASE("a pair that slips has its force of sliding, though its kink was passed before it had quite come to that") {
  Iwan bundle({{3, 1.5}, {1, 4}}, 0.1);
  double slope = 0;
  const double p = 0.5 - 1e-7, before = bundle.force(p, slope);
  const double displacement = bundle.stretch(0, p) + bundle.slide(0, p);
  bundle.pass_kink(p);
  CHECK_EQ(bundle.force(p, slope), doctest::Approx(before + 3e-7).epsilon(1e-15));
  CHECK_EQ(slope, 1);
  CHECK(bundle.pair_yields(0, p));
  CHECK_EQ(bundle.pair_force(0, p), 1.5);
  CHECK_EQ(bundle.pair_force(0, 2), 1.5);
  CHECK_EQ(bundle.stretch(0, p) + bundle.slide(0, p), doctest::Approx(displacement).epsilon(1e-15));
  CHECK(std::abs(bundle.slide(0, p) + 1e-7) < 1e-15);
}

TEST_CASE("a jump of a bundle goes along its law, and what it loses is heat") {
  Random random(7);
  const std::vector<Iwan::Pair> pairs = random_pairs(20, random);
  Plain plain(pairs, std::vector<double>(20, 0));
  Iwan bundle(pairs, 0.03);
  double p = 0, slope = 0;
  for (int k = 0; k < 40; ++k) {
    const double step = k == 7 ? 0 : random(-2, 2), before = plain.heat;
    const double heat = bundle.jump(p, step);
    p += step;
    plain.move(p);
    CHECK(std::abs(heat - (plain.heat - before)) <= rounding * (1 + plain.heat));
    CHECK(std::abs(bundle.force(p, slope) - plain.sum()) <= rounding * plain.scale());
  }
}

}  // namespace rheonet::test::iwan_test
