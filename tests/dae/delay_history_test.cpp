#include "core/dae/delay_history.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scene_builder.hpp"

namespace rheonet::test::delay_history_test {

namespace {

constexpr double delay = 0.37;

/// A branch from a free node to a moved one that feels what they do after `delay`.
struct Remembering {
  Scene scene;
  Network network;
  DelayHistory history;

  Remembering() : scene(make()), network(build_network(scene)), history(network, {}, 0, 0, HUGE_VAL, {1, 1, 1}) { history.begin({0, 0, 0}); }
  static Scene make() {
    SceneBuilder b;
    b.at("m", "mass", "free", {{"mass", 1}});
    b.motion("drive", "moved", "velocity", Signal(Signal::Constant{0}));
    b.between("v", "vfm", "free", "moved", {{"damping", 2}, {"stiffness", 3}, {"delay", delay}});
    return b.finish(1, 1, 1e-6);
  }
  void remember(double t, double v) { history.remember(t, {0, v, 0}, {}); }
  double felt(double t) const {
    const DelayHistory::Felt f = history.felt(0, t);
    CHECK_EQ(f.present.value, 0);
    return f.known.value;
  }
};

double quintic(double t) { return 0.3 - 1.7 * t + t * t * (2.1 - t * (0.8 + t * (1.3 - 0.9 * t))); }

}  // namespace

TEST_CASE("past: polynomials up to the highest order of the integrator are remembered exactly, whatever the steps") {
  Remembering r;
  r.history.mark(0, true);
  double t = 0;
  r.remember(0, quintic(0));
  for (int k = 1; t < 3; ++k) {
    t += 0.01 + 0.05 * std::abs(std::sin(k * k));
    r.remember(t, quintic(t));
    for (const double back : {0.0, 0.003, 0.011, 0.3}) {
      const double now = std::max(t - back, 0.2);
      if (now - delay < 0.25 || now > t) continue;  // the first steps have fewer points
      CHECK(r.felt(now) == doctest::Approx(quintic(now - delay)).epsilon(1e-11));
    }
  }
}

TEST_CASE("past: what is remembered is bounded by the delay, however long the run") {
  constexpr double step = 1e-3, between_breaks = 0.05;
  Remembering r;
  std::size_t most = 0;
  double next = 0;
  for (int k = 0; k < 200000; ++k) {
    const double t = step * k;
    if (t >= next) {
      r.history.mark(t, true);
      r.history.follow(0, t, Piece{.level = std::sin(t)}, false);
      r.history.moved(t, {0, 1e-3, 0});
      next += between_breaks;
    }
    r.remember(t, std::cos(t));
    if (k == 2000) most = r.history.held();
    if (k > 2000) REQUIRE_LE(r.history.held(), 2 * most);
  }
  CHECK_GT(most, delay / step);
  CHECK_LT(most, 3 * delay / step);
}

TEST_CASE("past: beyond the last step the present is one more point, with its weight, and rates are those of the whole") {
  const auto cubic = [](double t) { return 0.3 - t * (1.7 - t * (2.1 - 0.8 * t)); };
  const auto slope = [](double t) { return -1.7 + t * (4.2 - 2.4 * t); };
  Remembering r;
  r.history.mark(0, true);
  double t = 0;
  r.remember(0, cubic(0));
  for (int k = 1; k < 9; ++k) {
    t += 0.1 + 0.05 * k;
    r.remember(t, cubic(t));
  }
  for (const double step : {1.2 * delay, 1.7 * delay, 5 * delay}) {
    const double now = t + step, then = now - delay;
    const DelayHistory::Felt f = r.history.felt(0, now);
    CHECK(f.present.value != 0);
    const Dual felt = f.known + f.present * Dual(cubic(now), slope(now));
    CHECK_EQ(felt.value, doctest::Approx(cubic(then)).epsilon(1e-11));
    CHECK_EQ(felt.derivative, doctest::Approx(slope(then)).epsilon(1e-10));
  }
  CHECK_EQ(r.history.felt(0, t + 0.9 * delay).present.value, 0);
}

TEST_CASE("past: rates that are known are told; no step is longer than what is said") {
  SceneBuilder b;
  b.at("m", "mass", "free", {{"mass", 1}});
  const Scene scene = b.finish(1, 1, 1e-6);
  const Network network = build_network(scene);
  DelayHistory history(network, {delay}, delay, 2, delay, {1, 1});
  history.begin({0, 0});
  history.mark(0, true);
  for (int k = 0; k < 9; ++k) {
    const double t = 0.1 * k;
    history.remember(t, {0, 0}, {{std::sin(9 * t), 100 + t}, {std::sin(9 * t), std::nan("")}});
  }
  CHECK_EQ(history.channel(0, 0.43, 0, 0.8).known.derivative, doctest::Approx(100.43).epsilon(1e-12));
  CHECK_EQ(history.channel(1, 0.43, 0, 0.8).known.derivative, doctest::Approx(9 * std::cos(9 * 0.43)).epsilon(0.05));
  CHECK_EQ(history.channel(0, 0.43, 0, 0.8).known.value, history.channel(1, 0.43, 0, 0.8).known.value);
  CHECK_EQ(history.longest_step(), delay);
  CHECK(std::isinf(Remembering().history.longest_step()));
}

TEST_CASE("past: before the run nothing moves; the two sides of a jump, one delay later") {
  Remembering r;
  r.history.mark(0, true);
  for (int k = 0; k <= 20; ++k) r.remember(0.05 * k, 1 + 0.05 * k);
  r.history.mark(1, true);
  for (int k = 0; k <= 6; ++k) r.remember(1 + 0.05 * k, -5.0);
  CHECK_EQ(r.felt(delay / 2), 0);
  CHECK_EQ(r.history.next_break(), 1 + delay);
  const double through = 1 + delay;
  CHECK_EQ(r.felt(through), doctest::Approx(2).epsilon(1e-12));  // a step that ends there
  CHECK_EQ(r.felt(through - 0.01), doctest::Approx(1.99).epsilon(1e-12));
  r.history.mark(through, false);
  CHECK_EQ(r.felt(through), doctest::Approx(-5).epsilon(1e-12));  // one that begins there
  CHECK_EQ(r.felt(through + 0.01), doctest::Approx(-5).epsilon(1e-12));
}

TEST_CASE("past: a smooth break comes through a few times, one that jumps again and again") {
  for (const bool jumps : {false, true}) {
    Remembering r;
    double t = 0;
    r.history.mark(0, true);
    r.remember(0, 1);
    int times = 0;
    for (; std::isfinite(r.history.next_break()) && times < 50; ++times) {
      const double next = r.history.next_break();
      CHECK_EQ(next, doctest::Approx(t + delay).epsilon(1e-13));
      r.remember(next, 1);
      t = next;
      r.history.mark(t, false);
      r.remember(t, jumps ? 1 + 0.1 * ((times % 2) ? 1 : -1) : 1);
    }
    CHECK_EQ(times, jumps ? 50 : 5);
  }
}

TEST_CASE("past: a move in no time is felt once, by both ends with their signs") {
  Remembering r;
  r.history.mark(0, true);
  r.history.mark(0.2, true);
  r.history.moved(0.2, {0, 0.03, 0.01});
  CHECK_EQ(r.history.take_steps(0, 0.2 + delay / 2), 0);
  CHECK_EQ(r.history.take_steps(0, 0.2 + delay), doctest::Approx(0.02).epsilon(1e-14));
  CHECK_EQ(r.history.take_steps(0, 0.2 + delay), 0);
}

}  // namespace rheonet::test::delay_history_test
