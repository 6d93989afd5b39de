// vfm with a transport delay: (B/sigma) df/dt + f = B w(t - TD), P. L. Dahl 1982, Eq. 62.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "tests/support/check.hpp"
#include "tests/support/response.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test::delay_test {

namespace {

constexpr double B = 1.9, sigma = 31.0, TD = 0.075;

/// The classical Runge-Kutta method with a fixed step that divides the delay, for y' = f(t, y, y(t - delay)). The delayed value at a half
/// step is interpolated from values and derivatives (Hermite). y = 0 before t = 0.
struct Delayed {
  std::vector<double> y0;
  std::function<std::vector<double>(double t, const std::vector<double>& y, const std::vector<double>& past)> f;
  int steps_in_delay = 600;

  std::vector<std::vector<double>> solve(double delay, double stop, std::vector<double>& times) const {
    const double h = delay / steps_in_delay;
    const std::size_t n = y0.size();
    const std::vector<double> none(n, 0);
    std::vector<std::vector<double>> y{y0}, dy;
    times = {0};
    const auto past = [&](std::size_t k, bool half) {
      if (k < static_cast<std::size_t>(steps_in_delay)) return none;
      const std::size_t j = k - static_cast<std::size_t>(steps_in_delay);
      if (!half) return y[j];
      std::vector<double> middle(n);
      // The derivative at the end of a step that is not known yet is that of the step itself.
      for (std::size_t i = 0; i < n; ++i) middle[i] = (y[j][i] + y[j + 1][i]) / 2 + h / 8 * (dy[j][i] - dy[j + 1][i]);
      return middle;
    };
    const auto add = [&](const std::vector<double>& a, double c, const std::vector<double>& b) {
      std::vector<double> sum(n);
      for (std::size_t i = 0; i < n; ++i) sum[i] = a[i] + c * b[i];
      return sum;
    };
    for (std::size_t k = 0; times.back() < stop - h / 2; ++k) {
      const double t = times.back();
      // The limit from the right at the first instant at which something comes through.
      const std::vector<double> before = past(k, false), after = past(k + 1, false), middle = past(k, true);
      const auto k1 = f(t, y.back(), before);
      dy.push_back(k1);
      // After the last step within one delay nothing has come through yet at its end.
      const bool first = k + 1 == static_cast<std::size_t>(steps_in_delay);
      const auto k2 = f(t + h / 2, add(y.back(), h / 2, k1), middle), k3 = f(t + h / 2, add(y.back(), h / 2, k2), middle),
                 k4 = f(t + h, add(y.back(), h, k3), first ? none : after);
      std::vector<double> next = y.back();
      for (std::size_t i = 0; i < n; ++i) next[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
      y.push_back(next);
      times.push_back(times.back() + h);
    }
    return y;
  }
};

}  // namespace

TEST_CASE("a delayed vfm on a given motion: the force of one without delay, later by just the delay") {
  const auto position = [](Signal s) { return std::pair{std::string("position"), s}; };
  const auto velocity = [](Signal s) { return std::pair{std::string("velocity"), s}; };
  const std::pair<std::string, Signal> drives[] = {
      velocity(Signal(Signal::Constant{0.7})),
      velocity(Signal(Signal::Step{0.7, 0.11, 0.1})),
      velocity(Signal(Signal::Sine{0.7, 3.1, 0.4, 0, 0.2})),
      velocity(Signal(Signal::Square{0.7, 5.3, 0.3, 0.05, 0})),
      velocity(Signal(Signal::Chirp{0.7, 1, 9, 0.8, 0, 0, 0})),
      position(Signal(Signal::Step{0.013, 0.11, 0})),
      position(Signal(Signal::Square{0.013, 4.7, 0.3, 0, 0})),
      position(Signal(Signal::Triangle{0.013, 4.7, 0.3, 0, 0})),
      position(Signal(Signal::Sine{0.013, 3.1, 0.4, 0, 0})),
  };
  constexpr int shift = 15;  // rows
  constexpr double every = TD / shift, accuracy = 1e-9;
  constexpr int rows = 200;
  for (const auto& drive : drives) {
    const std::string& parameter = drive.first;
    const Signal& signal = drive.second;
    CAPTURE(signal.shape().index());
    for (const bool reversed : {false, true}) {
      SceneBuilder b;
      b.motion("drive", "a", parameter, signal);
      const char* ends[] = {"a", "ground"};
      b.between("now", "vfm", ends[reversed], ends[!reversed], {{"damping", B}, {"stiffness", sigma}});
      b.between("later", "vfm", ends[reversed], ends[!reversed], {{"damping", B}, {"stiffness", sigma}, {"delay", TD}});
      b.between("much_later", "vfm", ends[reversed], ends[!reversed], {{"damping", B}, {"stiffness", sigma}, {"delay", 7.7}});
      const RunTable run = simulate(b.finish(rows * every, rows, accuracy));
      const std::vector<double>&now = run["now.force"], &later = run["later.force"];
      double worst = 0;
      for (std::size_t k = 0; k < later.size(); ++k) {
        const double expected = k < shift ? 0 : now[k - shift];
        worst = std::max(worst, std::abs(later[k] - expected));
      }
      CHECK(worst <= 2 * accuracy * run.scale("now.force"));
      CHECK(run.scale("later.force") > 0.5 * run.scale("now.force"));
      CHECK_EQ(run.scale("much_later.force"), 0);
    }
  }
}

// T f' + f = B a cos(omega (t - TD)) from t = TD on.
TEST_CASE("delays far shorter and far longer than a step: a given motion comes through exactly, and they cost no steps") {
  constexpr double a = 0.7, omega = 5.3, stop = 4.1, T = B / sigma;
  const auto late = [](double delay) {
    const Response f = (B * Response::sine(a, omega)).lag(T, 0);
    return from(delay, f);
  };
  for (const double accuracy : accuracies) {
    SceneBuilder b;
    b.motion("drive", "a", "velocity", Signal(Signal::Sine{a, omega / (2 * std::numbers::pi), 0, 0, 0}));
    const std::pair<std::string, double> delays[] = {{"tiny", 1e-9}, {"short", 1e-5}, {"long", 3.3}};
    for (const auto& [name, delay] : delays)
      b.between(name, "vfm", "a", "ground", {{"damping", B}, {"stiffness", sigma}, {"delay", delay}});
    Summary summary;
    const RunTable run = simulate(b.finish(stop, 100, accuracy), &summary);
    for (const auto& [name, delay] : delays) check_against(run, {name + ".force", late(delay)}, accuracy);
    CHECK_LT(summary.steps, 20000);
  }
}

// m dv/dt = -f at a free mass. A delay of 1e-4 s, which is shorter than a step, changes the motion by a fraction of the order of the delay.
TEST_CASE("a delay far shorter than what happens changes it by as little") {
  const auto run = [](double delay) {
    SceneBuilder b;
    b.at("m", "mass", "a", {{"mass", 0.43}});
    b.start("a", 0, 1.3);
    b.between("k", "spring", "ground", "a", {{"stiffness", 3.7}});
    b.between("v", "vfm", "ground", "a", {{"damping", B}, {"stiffness", sigma}, {"delay", delay}});
    return simulate(b.finish(1.2, 60, 1e-8));
  };
  const RunTable none = run(0);
  double worst[2] = {0, 0};
  for (const double delay : {4e-4, 1e-4}) {
    const RunTable some = run(delay);
    for (std::size_t row = 0; row < none.time().size(); ++row)
      worst[delay < 2e-4] = std::max(worst[delay < 2e-4], std::abs(some["a.velocity"][row] - none["a.velocity"][row]));
  }
  CHECK_GT(worst[1], 1e-5);
  CHECK_LT(worst[1], 3e-3);
  CHECK_EQ(worst[0] / worst[1], doctest::Approx(4).epsilon(0.02));
}

TEST_CASE("a mass that a delayed vfm slows down: what it does now depends on what it did") {
  constexpr double m = 0.43, k = 3.7, v0 = 1.3;
  for (const double delay : {TD, 0.4, 2e-3}) {
    for (const double accuracy : accuracies) {
      CAPTURE(delay);
      CAPTURE(accuracy);
      // y = f, v, x
      const Delayed reference{{0, v0, 0}, [&](double, const std::vector<double>& y, const std::vector<double>& past) {
                                return std::vector<double>{sigma * (past[1] - y[0] / B), (-y[0] - k * y[2]) / m, y[1]};
                              }, delay < 0.01 ? 20 : 600};
      std::vector<double> times;
      const double stop = 1.2;
      const std::vector<std::vector<double>> y = reference.solve(delay, stop, times);
      SceneBuilder b;
      b.at("m", "mass", "a", {{"mass", m}});
      b.start("a", 0, v0);
      b.between("k", "spring", "ground", "a", {{"stiffness", k}});
      b.between("v", "vfm", "ground", "a", {{"damping", B}, {"stiffness", sigma}, {"delay", delay}});
      const int rows = 60;
      Summary summary;
      const RunTable run = simulate(b.finish(stop, rows, accuracy), &summary);
      const auto at = [&](std::size_t column, double sign) {
        return [&, column, sign](double t) {
          const auto row = static_cast<std::size_t>(std::llround(t / stop * static_cast<double>(y.size() - 1)));
          REQUIRE(std::abs(times[row] - t) < 1e-9);
          return sign * y[row][column];
        };
      };
      check_against(run, {"v.force", at(0, -1)}, accuracy);
      check_against(run, {"a.velocity", at(1, 1)}, accuracy);
      check_against(run, {"a.position", at(2, 1)}, accuracy);
      CHECK(std::abs(summary.missing) <= 10 * accuracy * summary.largest);
      if (delay < 0.01 && accuracy == 1e-3) CHECK_LT(static_cast<double>(summary.steps), stop / delay / 2);
    }
  }
}

TEST_CASE("without a mass: a delayed vfm behind a dashpot, and behind a spring") {
  constexpr double B1 = 4.3, k = 53.0, v = 0.8, stop = 0.6;
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    SceneBuilder b;
    b.motion("drive", "a", "velocity", Signal(Signal::Constant{v}));
    b.between("c", "dashpot", "a", "mid", {{"damping", B1}});
    b.between("v", "vfm", "mid", "ground", {{"damping", B}, {"stiffness", sigma}, {"delay", TD}});
    b.between("k", "spring", "a", "end", {{"stiffness", k}});
    b.between("u", "vfm", "end", "ground", {{"damping", B}, {"stiffness", sigma}, {"delay", TD}});
    const int rows = 80;
    const RunTable run = simulate(b.finish(stop, rows, accuracy));
    // Over the first delays by hand, with r = sigma/B: nothing comes through until TD; then the nodes felt move with v.
    constexpr double r = sigma / B;
    const auto begun = [&](double t) { return t < TD ? 0 : B * v * (1 - std::exp(-r * (t - TD))); };
    // From 2 TD on the dashpot's node was felt slower by f/B1: f' = sigma (v - f(t - TD)/B1) - r f.
    const auto behind_dashpot = [&](double t) {
      const double s = t - 2 * TD;
      return begun(t) - (s < 0 ? 0 : sigma / B1 * (B * v) * ((1 - std::exp(-r * s)) / r - s * std::exp(-r * s)));
    };
    // The spring's by f'/k, and f' itself jumps: f' = sigma (v - f'(t - TD)/k) - r f.
    const auto behind_spring = [&](double t) {
      const double s = t - 2 * TD;
      return begun(t) - (s < 0 ? 0 : sigma / k * (sigma * v) * s * std::exp(-r * s));
    };
    double worst_dashpot = 0, worst_spring = 0;
    for (std::size_t row = 0; run.time()[row] < 3 * TD; ++row) {
      const double t = run.time()[row];
      worst_dashpot = std::max(worst_dashpot, std::abs(run["v.force"][row] - behind_dashpot(t)));
      worst_spring = std::max(worst_spring, std::abs(run["u.force"][row] - behind_spring(t)));
    }
    CHECK(worst_dashpot <= 10 * accuracy * run.scale("v.force"));
    CHECK(worst_spring <= 10 * accuracy * run.scale("u.force"));
    CHECK(run.scale("v.force") > 0.5 * B * v);
  }
}

// The node of the spring follows the motion, without a force, until the delayed force arrives. Its motion is in no error test, but acts on
// the force a delay later: T f' + f = B A sin(w (t - TD)).
TEST_CASE("what follows a motion through a spring, without any force, is felt a delay later to the accuracy") {
  constexpr double A = 0.13, k = 200, lag = B / sigma, late = 0.7;
  for (const double frequency : {1.3, 5.1, 20.3}) {
    for (const double accuracy : accuracies) {
      CAPTURE(frequency);
      CAPTURE(accuracy);
      const double w = 2 * std::numbers::pi * frequency;
      SceneBuilder b;
      b.motion("drive", "a", "velocity", Signal(Signal::Sine{A, frequency, 0, 0, 0}));
      b.between("k", "spring", "a", "mid", {{"stiffness", k}});
      b.between("v", "vfm", "mid", "ground", {{"damping", B}, {"stiffness", sigma}, {"delay", late}});
      const RunTable run = simulate(b.finish(2 * late, 140, accuracy));
      const double gain = B * A / (1 + w * w * lag * lag);
      double worst = 0;
      for (std::size_t row = 0; row < run.time().size(); ++row) {
        const double t = run.time()[row] - late;
        const double f = t < 0 ? 0 : gain * (std::sin(w * t) - w * lag * (std::cos(w * t) - std::exp(-t / lag)));
        worst = std::max(worst, std::abs(run["v.force"][row] - f));
      }
      CHECK(worst <= accuracy * run.scale("v.force"));
    }
  }
}

TEST_CASE("a step through a spring comes back through the delay, again and again") {
  constexpr double k = 53.0, dx = 0.013, accuracy = 1e-9;
  SceneBuilder b;
  b.motion("drive", "a", "position", Signal(Signal::Step{dx, 0.02, 0}));
  b.between("k", "spring", "a", "end", {{"stiffness", k}});
  b.between("u", "vfm", "end", "ground", {{"damping", B}, {"stiffness", sigma}, {"delay", TD}});
  const RunTable run = simulate(b.finish(2.5 * TD, 500, accuracy));
  constexpr double r = sigma / B;
  for (std::size_t row = 0; row < run.time().size(); ++row) {
    const double s = run.time()[row] - 0.02 - TD, s2 = s - TD;
    // One delay after the step the force jumps by sigma dx, and relaxes; what the end does then comes one delay later.
    double f = s < 0 ? 0 : sigma * dx * std::exp(-r * s);
    if (s2 >= 0) f -= sigma / k * (sigma * dx) * std::exp(-r * s2) * (1 - r * s2);
    CHECK(std::abs(run["u.force"][row] - f) <= 10 * accuracy * sigma * dx);
  }
}

TEST_CASE("a delayed spring or dashpot there is none: refused with its place") {
  for (const char* limit : {"damping = \"inf\", stiffness = 3", "damping = 3, stiffness = \"inf\""}) {
    const std::string toml = "[elements]\nm = { type = \"mass\", at = \"a\", mass = 1 }\nv = { type = \"vfm\", between = "
                             "[\"a\", \"ground\"], " + std::string(limit) + ", delay = 0.1 }\n[simulate]\nstop = 1\n";
    CHECK_MESSAGE(refusal(toml).find("3:88: error: `delay` needs finite `damping` and `stiffness`") != std::string::npos,
                  refusal(toml));
  }
}

}  // namespace rheonet::test::delay_test
