// Signal blocks alone, against closed forms, and the events that limits are.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/check.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::blocks_test {

namespace {

constexpr double pi = std::numbers::pi;

/// Blocks need a network beside them: one that does nothing.
std::string scene(const std::string& blocks, double stop, int points, const std::string& more = "") {
  return fmt::format(
      "[elements]\nk = {{ type = \"spring\", between = [\"a\", \"ground\"], stiffness = 1 }}\n"
      "m = {{ type = \"mass\", at = \"a\", mass = 1 }}\n{}\n[simulate]\nstop = {}\noutput = {{ points = {}{} }}\n",
      blocks, stop, points, more);
}

/// Largest difference of a record from a function of time, in parts of its largest magnitude.
double error(const RunTable& run, const std::string& record, const std::function<double(double)>& expected) {
  double worst = 0;
  for (std::size_t k = 0; k < run.time().size(); ++k)
    worst = std::max(worst, std::abs(run[record][k] - expected(run.time()[k])));
  return worst / run.scale(record);
}

}  // namespace

TEST_CASE("a lag follows a step: K (1 - exp(-t/T))") {
  constexpr double T = 0.13, K = 2.7, y0 = -0.4, step = 1.9, t0 = 0.21;
  const std::string text =
      scene(fmt::format("g = {{ type = \"generator\", signal = {{ step = {}, time = {} }} }}\n"
                        "y = {{ type = \"lag\", in = \"g\", time_constant = {}, gain = {}, initial = {} }}",
                        step, t0, T, K, y0),
            1.1, 111);
  for (const double accuracy : accuracies) {
    const double worst = error(simulate(text, accuracy), "y.out", [=](double t) {
      const double begin = y0 * std::exp(-std::min(t, t0) / T);
      return t < t0 ? begin : K * step + (begin - K * step) * std::exp(-(t - t0) / T);
    });
    CHECK(worst <= accuracy);
  }
}

TEST_CASE("an integrator of a square wave is a triangle wave") {
  constexpr double a = 3.1, f = 1.7, K = -0.6, y0 = 0.25;
  const std::string text = scene(fmt::format("g = {{ type = \"generator\", signal = {{ square = {}, frequency = {} }} }}\n"
                                             "y = {{ type = \"integrator\", in = \"g\", gain = {}, initial = {} }}",
                                             a, f, K, y0),
                                 2.3, 116);
  for (const double accuracy : accuracies) {
    const double worst = error(simulate(text, accuracy), "y.out", [=](double t) {
      const double phase = t * f - std::floor(t * f);
      return y0 + K * a / f * std::min(phase, 1 - phase);
    });
    CHECK(worst <= accuracy);
  }
}

TEST_CASE("a limiter cuts a sine off, and its corners are events at their times") {
  constexpr double a = 3.0, f = 1.3, upper = 2.0, lower = -1.0;
  const std::string text =
      scene(fmt::format("g = {{ type = \"generator\", signal = {{ sine = {}, frequency = {} }} }}\n"
                        "y = {{ type = \"limiter\", in = \"g\", upper = {}, lower = {} }}\n"
                        "z = {{ type = \"integrator\", in = \"y\" }}",
                        a, f, upper, lower),
            1 / f, 101, ", events = true");
  // Where it reaches and leaves its limits, in the first period.
  const double up = std::asin(upper / a) / (2 * pi * f), down = std::asin(-lower / a) / (2 * pi * f);
  const double corners[] = {up, 0.5 / f - up, 0.5 / f + down, 1 / f - down};
  for (const double accuracy : accuracies) {
    const Scene read = scene_of(text, accuracy);
    std::vector<double> found;
    const RunTable run = simulate(read);
    const std::vector<double>& t = run.time();
    for (std::size_t k = 1; k < t.size(); ++k)
      if (t[k] == t[k - 1]) found.push_back(t[k]);
    REQUIRE_EQ(found.size(), 4);
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(found[k] - corners[k]) < 1e-12);
    CHECK(error(run, "y.out", [=](double s) { return std::clamp(a * std::sin(2 * pi * f * s), lower, upper); }) < 1e-12);
    const auto sines = [](double s) { return a * (1 - std::cos(2 * pi * f * s)) / (2 * pi * f); };
    const double end = sines(up) + upper * (0.5 / f - 2 * up) + sines(up) - (sines(down) + -lower * (0.5 / f - 2 * down) + sines(down));
    CHECK(std::abs(run["z.out"].back() - end) <= accuracy * run.scale("z.out"));
  }
}

TEST_CASE("a limit that is only just reached, and left again within one step, is seen") {
  // The crest is 1e-6 above the limit, for 0.2 ms of a period of 1 s.
  const std::string text = scene(
      "g = { type = \"generator\", signal = { sine = 1, frequency = 1 } }\n"
      "y = { type = \"limiter\", in = \"g\", upper = 0.999999 }\nz = { type = \"integrator\", in = \"y\" }",
      0.6, 4, ", events = true");
  const RunTable run = simulate(text, 1e-3);
  const double up = std::asin(0.999999) / (2 * pi);
  REQUIRE_EQ(run.time().size(), 8);
  CHECK(std::abs(run.time()[2] - up) < 1e-9);
  CHECK(std::abs(run.time()[4] - (0.5 - up)) < 1e-9);
}

TEST_CASE("a limiter on one side, and one that nothing reaches") {
  const RunTable run = simulate(scene(
      "g = { type = \"generator\", signal = { sine = 2, frequency = 1 } }\n"
      "half = { type = \"limiter\", in = \"g\", upper = \"inf\", lower = 0 }\n"
      "wide = { type = \"limiter\", in = \"-g\", upper = 2.1 }",
      2, 41));
  CHECK(error(run, "half.out", [](double t) { return std::max(0.0, 2 * std::sin(2 * pi * t)); }) < 1e-12);
  CHECK(error(run, "wide.out", [](double t) { return -2 * std::sin(2 * pi * t); }) < 1e-12);
}

TEST_CASE("a dead band is felt beyond its bound, though within it all cancels") {
  // A governor: above w the force brakes with B.
  constexpr double w = 0.53, B = 1.3e4, F = 3.1, m = 1.2;
  const std::string text = fmt::format(
      "[elements]\nm = {{ type = \"mass\", at = \"m\", mass = {} }}\npush = {{ type = \"force\", at = \"m\", force = {} }}\n"
      "lim = {{ type = \"limiter\", in = \"m.velocity\", upper = {} }}\n"
      "over = {{ type = \"sum\", in = [\"m.velocity\", \"-lim\"] }}\n"
      "g = {{ type = \"gain\", in = \"over\", gain = {} }}\n"
      "brake = {{ type = \"force\", at = \"m\", force = {{ block = \"g\" }} }}\n[simulate]\nstop = 0.6\noutput = {{ points = 61 }}\n",
      m, F, w, -B);
  const double reached = w * m / F;
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    Summary summary;
    const RunTable run = simulate(scene_of(text, accuracy), &summary);
    CHECK(summary.steps < 500);
    CHECK(error(run, "m.velocity", [&](double t) {
            return t < reached ? F / m * t : w + F / B * (1 - std::exp(-B / m * (t - reached)));
          }) < 10 * accuracy);
  }
}

TEST_CASE("gain and sum: signs, and a signal that is taken in twice") {
  const RunTable run = simulate(scene(
      "u = { type = \"generator\", signal = { ramp = 0.7 } }\nv = { type = \"generator\", signal = 1.3 }\n"
      "w = { type = \"sum\", in = [\"u\", \"-v\", \"u\", \"-x\"] }\nx = { type = \"gain\", in = \"-v.out\", gain = 5 }",
      1, 11));
  CHECK(error(run, "w.out", [](double t) { return 1.4 * t - 1.3 + 6.5; }) < 1e-13);
}

TEST_CASE("a delay puts out what was put in, exactly so much later") {
  constexpr double T = 0.317, y0 = 0.9;
  const struct { const char* signal; std::function<double(double)> value; } signals[] = {
      {"1.7", [](double) { return 1.7; }},
      {"{ sine = 1.7, frequency = 2.3, phase = 0.4, offset = 0.2 }", [](double t) { return 1.7 * std::sin(4.6 * pi * t + 0.4) + 0.2; }},
      {"{ step = 1.7, time = 0.11 }", [](double t) { return t < 0.11 ? 0 : 1.7; }},
      {"{ square = 1.7, frequency = 2.3 }", [](double t) { return 2.3 * t - std::floor(2.3 * t) < 0.5 ? 1.7 : -1.7; }},
      {"{ ramp = 1.7, time = 0.11 }", [](double t) { return 1.7 * std::max(0.0, t - 0.11); }},
  };
  for (const auto& one : signals) {
    const std::string signal = one.signal;
    const auto& value = one.value;
    CAPTURE(signal);
    const std::string text = scene(
        fmt::format("g = {{ type = \"generator\", signal = {} }}\nh = {{ type = \"gain\", in = \"g\", gain = -0.5 }}\n"
                    "d = {{ type = \"delay\", in = \"h\", delay = {}, initial = {} }}\n"
                    "dd = {{ type = \"delay\", in = \"d\", delay = 0.05 }}\nnow = {{ type = \"delay\", in = \"h\", delay = 0 }}\n"
                    "much = {{ type = \"delay\", in = \"g\", delay = 7, initial = 3 }}\n"
                    "z = {{ type = \"integrator\", in = \"d\" }}",
                    signal, T, y0),
        1.313, 202);
    const RunTable run = simulate(text, 1e-9);
    const auto delayed = [&value](double t) { return t < T ? y0 : -0.5 * value(t - T); };
    CHECK(error(run, "d.out", delayed) < 1e-9);
    CHECK(error(run, "dd.out", [&](double t) { return t < 0.05 ? 0 : delayed(t - 0.05); }) < 1e-9);
    CHECK(error(run, "now.out", [&value](double t) { return -0.5 * value(t); }) < 1e-12);
    CHECK(error(run, "much.out", [](double) { return 3; }) == 0);
    // The jump of the delayed signal is met by the integrator on its time: the trapezoids between rows miss it.
    double area = 0;
    constexpr int grid = 200000;
    for (int k = 0; k < grid; ++k) area += delayed((k + 0.5) * 1.313 / grid) * 1.313 / grid;
    CHECK(std::abs(run["z.out"].back() - area) < 2e-5 * run.scale("z.out"));
  }
}

TEST_CASE("a jump stays sharp through a chain of delays") {
  std::string blocks = "d0 = { type = \"generator\", signal = { step = 1, time = 0.05 } }\ny = { type = \"integrator\", in = \"d9\" }\n";
  for (int k = 1; k <= 9; ++k) blocks += fmt::format("d{} = {{ type = \"delay\", in = \"d{}\", delay = 0.1 }}\n", k, k - 1);
  const RunTable run = simulate(scene(blocks, 1.3, 27), 1e-3);
  CHECK(error(run, "y.out", [](double t) { return std::max(0.0, t - 0.95); }) < 1e-12);
}

// x' = -k x(t - T), x = 1 until 0, for 5 s.
static std::string delayed_feedback(double T, double k, int rows) {
  return scene(fmt::format("x = {{ type = \"integrator\", in = \"rate\", initial = 1 }}\n"
                           "late = {{ type = \"delay\", in = \"x\", delay = {}, initial = 1 }}\n"
                           "rate = {{ type = \"gain\", in = \"late\", gain = {} }}",
                           T, -k),
               5, rows);
}

// In the n-th interval of length T a polynomial of degree n,
// x(t) = sum over j of (-k)^j (t - (j - 1) T)^j / j! for the j with t >= (j - 1) T.
TEST_CASE("delayed feedback: the method of steps") {
  constexpr double k = 1.37, T = 0.8;
  const std::string text = delayed_feedback(T, k, 201);
  for (const double accuracy : accuracies) {
    const double worst = error(simulate(text, accuracy), "x.out", [=](double t) {
      double sum = 0, factorial = 1;
      for (int j = 0; t >= (j - 1) * T; ++j) {
        if (j > 0) factorial *= j;
        sum += std::pow(-k * (t - (j - 1) * T), j) / factorial;
      }
      return sum;
    });
    CHECK(worst <= accuracy);
  }
}

// The same for a delay T much shorter than a step. By the Laplace transform x = exp(l (t + T))/(1 + l T), where l = -k exp(-l T) is the root
// nearest to 0. The other roots have decayed after some delays.
TEST_CASE("delayed feedback through a delay much shorter than a step") {
  constexpr double k = 1.37;
  for (const double T : {1e-2, 1e-4, 1e-7, 1e-12}) {
    CAPTURE(T);
    double l = -k;
    for (int j = 0; j < 50; ++j) l = -k * std::exp(-l * T);
    const std::string text = delayed_feedback(T, k, 11);
    for (const double accuracy : accuracies) {
      Summary summary;
      const RunTable run = simulate(scene_of(text, accuracy), &summary);
      double worst = 0;
      for (std::size_t row = 1; row < run.time().size(); ++row)
        worst = std::max(worst, std::abs(run["x.out"][row] - std::exp(l * (run.time()[row] + T)) / (1 + l * T)));
      CHECK(worst <= accuracy);
      CHECK_LT(summary.steps, 2000);
    }
  }
}

// The force of a motion that comes through a delay is its mass times the acceleration of a while ago, as exact as all else.
TEST_CASE("the force of a motion that follows a state or a mass of a while ago") {
  constexpr double k = 30, m = 2, V = 1.3, T = 0.35, tau = 0.3, w = 4.4;
  const double w0 = std::sqrt(k);
  const std::string text = fmt::format(R"([elements]
k    = {{ type = "spring", between = ["x", "ground"], stiffness = {} }}
m    = {{ type = "mass", at = "x", mass = 1 }}
then = {{ type = "delay", in = "x.velocity", delay = {} }}
mv   = {{ type = "motion", at = "a", velocity = {{ block = "then" }} }}
ma   = {{ type = "mass", at = "a", mass = {} }}
g    = {{ type = "generator", signal = {{ sine = 1, frequency = {} }} }}
lag  = {{ type = "lag", in = "g", time_constant = {} }}
late = {{ type = "delay", in = "lag", delay = {} }}
mw   = {{ type = "motion", at = "b", velocity = {{ block = "late" }} }}
mb   = {{ type = "mass", at = "b", mass = {} }}
[nodes]
x = {{ velocity = {} }}
[simulate]
stop = 4
output = {{ every = 0.01 }}
record = ["mv.force", "mw.force"]
)", k, T, m, w / (2 * std::numbers::pi), tau, T, m, V);
  // The lag: T y' = sin(w t) - y from rest.
  const auto lag_rate = [](double t) {
    const double gain = 1 / (1 + w * w * tau * tau);
    const double y = gain * (std::sin(w * t) - w * tau * (std::cos(w * t) - std::exp(-t / tau)));
    return (std::sin(w * t) - y) / tau;
  };
  for (const double accuracy : accuracies) {
    const RunTable run = simulate(text, accuracy);
    double mass = 0, state = 0;
    for (std::size_t row = 0; row < run.time().size(); ++row) {
      const double then = run.time()[row] - T;
      if (std::abs(then) < 1e-9) continue;
      mass = std::max(mass, std::abs(std::abs(run["mv.force"][row]) - (then < 0 ? 0 : m * V * w0 * std::abs(std::sin(w0 * then)))));
      state = std::max(state, std::abs(std::abs(run["mw.force"][row]) - (then < 0 ? 0 : m * std::abs(lag_rate(then)))));
    }
    CHECK(mass <= accuracy * run.scale("mv.force"));
    CHECK(state <= accuracy * run.scale("mw.force"));
  }
}

TEST_CASE("blocks that start steady: a lag at its end, a delay of what has always been") {
  const std::string blocks =
      "g = { type = \"generator\", signal = { cosine = 3, frequency = 0.5 } }\n"
      "y = { type = \"lag\", in = \"g\", time_constant = 0.2, gain = 2 }\n"
      "d = { type = \"delay\", in = \"y\", delay = 0.4 }\n"
      "f = { type = \"force\", at = \"a\", force = { block = \"d\" } }";
  const RunTable run = simulate(scene(blocks, 1, 11) + "start_from = \"steady\"\n");
  CHECK_EQ(run["y.out"][0], 6);
  for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(run["d.out"][k] - 6) < 1e-12);
  CHECK(std::abs(run["a.position"][0] - 6) < 1e-12);
  CHECK(run["d.out"].back() < 5.9);
}

}  // namespace rheonet::test::blocks_test
