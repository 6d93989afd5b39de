// The error that is estimated against the error that is made.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/network/error.hpp"
#include "core/result/certify.hpp"
#include "core/result/trajectory.hpp"
#include "tests/support/check.hpp"
#include "tests/support/scene_file.hpp"
#include "tests/support/simulate.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::certify_test {

namespace {

/// Certifies a scene and keeps its rows.
struct Certified {
  Certificate certificate;
  std::vector<double> times;
  std::vector<std::vector<double>> rows;

  explicit Certified(const Scene& scene) {
    certificate = certify(scene, {.row = [this](double t, const std::vector<double>& values) {
                            times.push_back(t);
                            rows.push_back(values);
                          }});
  }
  /// Largest error of a record, in parts of `scale`.
  double error(std::size_t record, double scale, const std::function<double(double)>& exact) const {
    double worst = 0;
    for (std::size_t i = 0; i < times.size(); ++i) worst = std::max(worst, std::abs(rows[i][record] - exact(times[i])));
    return worst / scale;
  }
};

/// Chua's circuit, scaled to three integrators: M. Komuro, R. Tokunaga, T. Matsumoto, L. O. Chua, A. Hotta, Int. J.
/// Bifurcation and Chaos 1 (1991) 139. Two of its motions part e-fold in about 3 s.
std::string chua(double stop) {
  return fmt::format(R"([elements]
x = {{ type = "integrator", in = "dx", gain = 15.6, initial = 0.7 }}
y = {{ type = "integrator", in = "dy" }}
z = {{ type = "integrator", in = "y", gain = -28 }}
dx = {{ type = "sum", in = ["y", "-x", "-steep", "-flat"] }}
dy = {{ type = "sum", in = ["x", "-y", "z"] }}
bend = {{ type = "limiter", in = "x", upper = 1 }}
steep = {{ type = "gain", in = "bend", gain = -0.429 }}
flat = {{ type = "gain", in = "x", gain = -0.714 }}
k = {{ type = "spring", between = ["a", "ground"], stiffness = 1 }}
[simulate]
stop = {}
output = {{ every = 0.1 }}
record = ["x.out", "y.out", "z.out"]
)",
                     stop);
}

}  // namespace

TEST_CASE("the estimate is at least the error that is made, and not much more") {
  // One scene that keeps all its errors, and one that forgets them.
  constexpr double w = 10, B = 3.7, k = 41;
  struct Case {
    std::string scene;
    double scale;
    std::function<double(double)> exact;
  };
  const Case cases[] = {
      {block_on_spring + "method = \"ida\"\nstop = 7.3\noutput = { points = 331 }\nrecord = [\"block.position\"]\n", 1e-3,
       [](double t) { return 1e-3 * std::cos(w * t); }},
      {fmt::format("[elements]\npull = {{ type = \"motion\", at = \"a\", velocity = 1 }}\n"
                   "oil = {{ type = \"vfm\", between = [\"a\", \"ground\"], damping = {}, stiffness = {} }}\n"
                   "[simulate]\nmethod = \"ida\"\nstop = 0.7\noutput = {{ points = 200 }}\nrecord = [\"oil.force\"]\n",
                   B, k),
       B * (1 - std::exp(-0.7 * k / B)), [](double t) { return B * (1 - std::exp(-t * k / B)); }},
  };
  for (const Case& c : cases) {
    for (const double accuracy : accuracies) {
      CAPTURE(c.scene);
      CAPTURE(accuracy);
      const Certified run(scene_of(c.scene, accuracy));
      REQUIRE(run.certificate.holds);
      REQUIRE(run.certificate.errors.size() == 1);
      const double made = run.error(0, c.scale, c.exact), estimated = run.certificate.errors[0].relative();
      CHECK(made <= accuracy);
      CHECK(made <= estimated);
      CHECK(estimated <= 1.6 * made + 5e-11);
      CHECK(run.certificate.runs == (accuracy < 1e-7 ? 3 : 2));
      CHECK(run.certificate.errors[0].scale == doctest::Approx(c.scale).epsilon(1e-3));
      CHECK(std::isnan(run.certificate.until));
    }
  }
}

TEST_CASE("rows and events are those of one run, the one that was measured, to the last bit") {
  for (const std::string netlist : {"teaching/oscillator-forced", "thesis/viscometer", "thesis/compare/bingham-by-nodes"}) {
    CAPTURE(netlist);
    const Scene scene = scene_of_file(netlist + ".toml");
    const Certified certified(scene);
    REQUIRE(certified.certificate.holds);
    const Trajectory plain = run_to_memory(scene, {.tolerance = certified.certificate.result().tolerance});
    CHECK(certified.times == plain.times);
    CHECK(certified.rows == plain.rows);
    CHECK(certified.certificate.summary.steps == plain.summary.steps);
  }
}

TEST_CASE("where the first run is not accurate enough a tighter one takes its place") {
  const Scene scene = scene_of(chua(20), 1e-3);
  const Certified certified(scene);
  const Certificate& certificate = certified.certificate;
  REQUIRE(certificate.holds);
  REQUIRE(certificate.rounds.size() > 1);
  CHECK(certificate.kept == certificate.rounds.size() - 1);
  CHECK(certificate.runs >= static_cast<int>(certificate.rounds.size()) + 1);
  CHECK(certificate.rounds.front().tolerance == 1e-3);
  CHECK(certificate.rounds.front().error.relative() > 1e-3);
  for (std::size_t i = 1; i < certificate.rounds.size(); ++i) {
    CHECK(certificate.rounds[i].tolerance == doctest::Approx(certificate.rounds[i - 1].tolerance / numerics::certificate_ratio));
  }
  // Against a run that is as tight as it can be, and knows nothing of this.
  const Trajectory truth = run_to_memory(scene, {.tolerance = 1e-12});
  for (std::size_t k = 0; k < 3; ++k) {
    double off = 0, scale = 0;
    for (std::size_t i = 0; i < truth.rows.size(); ++i) {
      off = std::max(off, std::abs(certified.rows[i][k] - truth.rows[i][k]));
      scale = std::max(scale, std::abs(truth.rows[i][k]));
    }
    CHECK(off <= 1e-3 * scale);
  }
}

TEST_CASE("chaos is not certified: what is kept is good for as long as it says") {
  const Scene scene = scene_of(chua(90), 1e-4);
  const Certified certified(scene);
  const Certificate& certificate = certified.certificate;
  CHECK_FALSE(certificate.holds);
  CHECK(certificate.obstacle.empty());
  CHECK(certificate.rounds.back().tolerance / numerics::certificate_ratio == doctest::Approx(1e-12).epsilon(1e-6));
  CHECK(certificate.rounds.back().error.relative() > 0.1);
  REQUIRE(certificate.until > 10);
  REQUIRE(certificate.until < 90);
  // By another method, of lower order: before that time both agree, and not long after it they do not.
  const Trajectory other = run_to_memory(scene, {.tolerance = 1e-12, .order = 4});
  double before = 0, after = 0;
  for (std::size_t i = 0; i < other.times.size(); ++i) {
    const double off = std::abs(certified.rows[i][0] - other.rows[i][0]) / certificate.errors[0].scale;
    (other.times[i] < certificate.until ? before : after) = std::max(other.times[i] < certificate.until ? before : after, off);
  }
  CHECK(before <= 1e-4);
  CHECK(after > 1e-2);
}

TEST_CASE("an accuracy near the end of double precision is certified by looser runs, or not at all") {
  const Certified reached(scene_of(oscillator, 5e-11));
  CHECK(reached.certificate.holds);
  CHECK(reached.certificate.result().tolerance == doctest::Approx(1e-10));
  const Certified beyond(scene_of(oscillator, 1e-12));
  CHECK_FALSE(beyond.certificate.holds);
  CHECK(beyond.certificate.rounds.size() == 1);
  CHECK(beyond.certificate.errors.front().relative() < 1e-9);
}

TEST_CASE("where no step can be more accurate, two runs with one error in common do not certify each other") {
  // Two inertias that a torque drives on, faster and faster, vibrate against each other 528 times: from 3e-8 on all runs have an error of 6e-9 or more.
  const double k = 1e5, a = 1, b = 10, torque = 100, rate = std::sqrt(k * (1 / a + 1 / b));
  for (const double accuracy : {3e-8, 3e-9}) {
    const Scene scene = scene_of(fmt::format(R"(
domain = "rotation"
[elements]
torque = {{ type = "torque", at = "a", torque = {} }}
a = {{ type = "inertia", at = "a", inertia = {} }}
k = {{ type = "spring", between = ["a", "b"], stiffness = {} }}
b = {{ type = "inertia", at = "b", inertia = {} }}
[simulate]
stop = 10
accuracy = {}
output = {{ every = 0.005 }}
record = ["k.velocity"]
)", torque, a, k, b, accuracy));
    const Certified run(scene);
    CAPTURE(accuracy);
    const double error = run.error(0, torque / a / rate, [&](double t) { return torque / a / rate * std::sin(rate * t); });
    CHECK((!run.certificate.holds || error <= accuracy));
    CHECK(run.certificate.holds == (accuracy > 1e-8));
  }
}

TEST_CASE("the few steps of a run that is mostly solved in closed form do not limit the run that measures it") {
  // The spring of 1e28 N/m leaves the time in which the slider sticks to IDA. The mass vibrates 1,600 times.
  const Scene scene = scene_of(R"(
[elements]
mass = { type = "mass", at = "a", mass = 1 }
spring = { type = "spring", between = ["a", "ground"], stiffness = 1e6 }
air = { type = "dashpot", between = ["a", "ground"], damping = 0.5 }
push = { type = "force", at = "a", force = { step = 1, time = 1 } }
block = { type = "mass", at = "b", mass = 1 }
rod = { type = "spring", between = ["b", "c"], stiffness = 1e28 }
grip = { type = "slider", between = ["c", "ground"], coulomb = 1e-3 }
pull = { type = "force", at = "b", force = { step = 2e-3, time = 0.9 } }
oil = { type = "dashpot", between = ["a", "b"], damping = 1e-6 }
[simulate]
stop = 10
accuracy = 1e-6
record = ["a.position", "spring.force"]
)");
  const Certificate certificate = certify(scene, {});
  CHECK(certificate.summary.arc_steps < certificate.summary.steps);
  CHECK(certificate.holds);
}

TEST_CASE("what misses an accuracy that leaves no room for a hundredth of the measuring run is certified by a tenth of it") {
  // A ball between two elastic walls: the errors of its first impact delay the second.
  const Scene scene = scene_of(R"(
[elements]
ball = { type = "mass", at = "a", mass = 0.7 }
walls = { type = "stop", between = ["a", "ground"], lower = -0.06, upper = 0.06, stiffness = 3e4 }
[nodes]
a = { velocity = 1.3 }
[simulate]
method = "ida"
stop = 0.3
accuracy = 1e-9
)");
  const Certified certified(scene);
  const Certificate& certificate = certified.certificate;
  REQUIRE(certificate.rounds.size() == 2);
  CHECK(certificate.rounds.front().error.relative() > 1e-9);
  CHECK(certificate.holds);
  CHECK(certificate.result().tolerance == doctest::Approx(1e-10));
  CHECK(certificate.runs == 6);
  // By runs that know nothing of this, of another order.
  const Trajectory other = run_to_memory(scene, {.tolerance = 1e-12, .order = 4});
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    for (std::size_t i = 0; i < other.times.size(); ++i) {
      CHECK(std::abs(certified.rows[i][k] - other.rows[i][k]) <= 2e-9 * certificate.errors[k].scale);
    }
  }
}

TEST_CASE("a scene that cannot be simulated leaves the rows up to there, as `run` does") {
  const Scene scene = scene_of(overcome);
  const auto written = [&](auto&& simulate_to) {
    std::FILE* file = std::tmpfile();
    CHECK_THROWS_AS(simulate_to(RunSettings{.csv = file}), SimulationError);
    const RunTable rows = read_rows(file);
    std::fclose(file);
    return rows.columns;
  };
  const auto certified = written([&](const RunSettings& settings) { certify(scene, settings); });
  CHECK(certified == written([&](const RunSettings& settings) { run(scene, settings); }));
  CHECK(certified.at("time").size() == 3);
}

TEST_CASE("simulations side by side do not know of each other") {
  std::vector<Scene> scenes;
  for (const std::string netlist : {"teaching/creep", "thesis/viscometer-servo-dry", "thesis/combined-friction",
                                    "thesis/solid-friction", "thesis/laws/vfm-delay"}) {
    scenes.push_back(scene_of_file(netlist + ".toml"));
  }
  std::vector<std::future<Trajectory>> beside;
  for (int copy = 0; copy < 2; ++copy) {
    for (const Scene& scene : scenes) {
      beside.push_back(std::async(std::launch::async, [&scene] { return run_to_memory(scene); }));
    }
  }
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const Trajectory trajectory = beside[k].get();
    CAPTURE(scenes[k % scenes.size()].title);
    CHECK(trajectory.rows == run_to_memory(scenes[k % scenes.size()]).rows);
  }
}

// The steps of a lightly damped oscillation beside a fast decay are at the limit of double precision: a tighter tolerance hardly shortens them, and
// a run to it has nearly the same error. The displacement is known by partial fractions.
TEST_CASE("certificate: a tighter run with the same error does not vouch for a run") {
  using Complex = std::complex<double>;
  const double k0 = 1e4, k1 = 1e4, c = 0.01, accuracy = 2e-8;
  const auto D = [&](Complex s) { return k0 * k1 + s * (k1 * c + s * (k0 + k1 + c * s)); };
  const auto slope = [&](Complex s) { return k1 * c + s * (2 * (k0 + k1) + 3 * c * s); };
  std::array<Complex, 2> poles{-(k0 + k1) / c, Complex(0, std::sqrt(k0 * k1 / (k0 + k1)))};
  for (int n = 0; n < 50; ++n) {
    for (Complex& p : poles) p -= D(p) / slope(p);
  }
  const auto x = [&](double t) {
    const auto part = [&, t](Complex p) { return ((k0 + k1 + c * p) / (p * slope(p)) * std::exp(p * t)).real(); };
    return (k0 + k1) / (k0 * k1) + part(poles[0]) + 2 * part(poles[1]);
  };
  const Scene scene = scene_of(R"([elements]
f  = { type = "force",   at = "a", force = 1 }
m  = { type = "mass",    at = "a", mass = 1 }
k0 = { type = "spring",  between = ["a", "b"], stiffness = 1e4 }
c0 = { type = "dashpot", between = ["a", "b"], damping = 0.01 }
k1 = { type = "spring",  between = ["b", "ground"], stiffness = 1e4 }
[simulate]
stop = 50
accuracy = 2e-8
method = "ida"
record = ["a.position"]
)");
  double worst = 0, largest = 0;
  const Certificate certificate = certify(scene, {.row = [&](double t, const std::vector<double>& row) {
    worst = std::max(worst, std::abs(row[0] - x(t)));
    largest = std::max(largest, std::abs(row[0]));
  }});
  CHECK((!certificate.holds || worst <= accuracy * largest));
  CHECK(certificate.errors.front().largest >= worst / 2);
}

}  // namespace rheonet::test::certify_test
