// Scenes whose memory or time once grew with the square of their size. Their rows are compared with closed forms, or with an
// independent integration.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <vector>

#include "tests/analytic/slider_checks.hpp"
#include "tests/support/check.hpp"
#include "tests/support/program.hpp"

namespace rheonet::test::large_scenes_test {

namespace {

constexpr double pi = std::numbers::pi;

/// CPU time of this process [s].
double cpu_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

// The pairs of a bundle between a prescribed motion and ground were integrated apart from each other, each with a table of all.
TEST_CASE("An Iwan bundle that a prescribed motion drives needs memory in proportion to its pairs") {
  constexpr int pairs = 20'000;
  const Folder folder(fmt::format(R"([models.pair]
ports = ["a", "b"]
parameters = ["k", "Fc"]
[models.pair.elements]
s = {{ type = "spring", between = ["a", "mid"], stiffness = "k" }}
f = {{ type = "slider", between = ["mid", "b"], coulomb = "Fc" }}
[elements]
drive  = {{ type = "motion", at = "x", position = {{ sine = 1.3, frequency = 1 }} }}
bundle = {{ type = "pair", between = ["x", "ground"], k = "2/n", Fc = "2*(j + 0.5)/n^2", repeat = {{ count = {}, as = "j", arrange = "parallel" }} }}
[simulate]
stop   = 0.75
output = {{ points = 31 }}
record = ["x.position", "bundle.force"]
)", pairs));
  // Each pair carries k x up to its Fc. On the way back the bundle carries F(X) - 2 F((X - x)/2) (Masing).
  const auto first = [](double x) {
    double force = 0;
    for (int j = 0; j < pairs; ++j) force += std::min(2 * x / pairs, 2 * (j + 0.5) / pairs / pairs);
    return force;
  };
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    folder.shell(fmt::format("ulimit -v 1000000; rheonet run scene.toml -q -o rows.csv --accuracy {}", accuracy), 0);
    std::FILE* const file = std::fopen((folder.path() / "rows.csv").c_str(), "r");
    REQUIRE(file);
    const RunTable rows = read_rows(file);
    std::fclose(file);
    for (std::size_t i = 0; i < rows.time().size(); ++i) {
      const double t = rows.time()[i], x = 1.3 * std::sin(2 * pi * t);
      const double exact = t <= 0.25 ? first(x) : first(1.3) - 2 * first((1.3 - x) / 2);
      CHECK(std::abs(rows["bundle.force"][i] - exact) <= accuracy * first(1.3));
    }
  }
}

// Each evaluation of the position integrated the velocity over all turns since the start.
TEST_CASE("A velocity chirp moves an oscillator in a time in proportion to its turns") {
  constexpr double m = 1, k = 1e4, c = 3, last = 1000;
  const std::string text = fmt::format(R"([elements]
drive = {{ type = "motion", at = "shaft", velocity = {{ chirp = 1, frequency = 0, end_frequency = {}, duration = 1 }} }}
k = {{ type = "spring", between = ["shaft", "m"], stiffness = {} }}
c = {{ type = "dashpot", between = ["shaft", "m"], damping = {} }}
m = {{ type = "mass", at = "m", mass = {} }}
[simulate]
stop   = 1
output = {{ points = 101 }}
record = ["m.position", "m.velocity"]
)", last, k, c, m);
  // Runge and Kutta's classical method with 1,000 steps in the shortest turn: its error is below 1e-11.
  constexpr int steps = 10'000;  // between two rows
  struct Motion { double shaft, x, v; };
  const auto rate = [&](double t, const Motion& s) {
    const double driven = std::sin(pi * last * t * t);
    return Motion{driven, s.v, (k * (s.shaft - s.x) + c * (driven - s.v)) / m};
  };
  const auto along = [](const Motion& s, const Motion& r, double h) { return Motion{s.shaft + h * r.shaft, s.x + h * r.x, s.v + h * r.v}; };
  std::vector<double> x{0}, v{0};
  Motion s{0, 0, 0};
  const double h = 0.01 / steps;
  for (int row = 0; row < 100; ++row) {
    for (int i = 0; i < steps; ++i) {
      const double t = (row * steps + i) * h;
      const Motion r1 = rate(t, s), r2 = rate(t + h / 2, along(s, r1, h / 2)), r3 = rate(t + h / 2, along(s, r2, h / 2)), r4 = rate(t + h, along(s, r3, h));
      s = along(along(along(along(s, r1, h / 6), r2, h / 3), r3, h / 3), r4, h / 6);
    }
    x.push_back(s.x);
    v.push_back(s.v);
  }
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const double begin = cpu_time();
    const RunTable rows = simulate(text, accuracy);
    CHECK(cpu_time() - begin < 10);  // 95 s with the integral computed anew
    REQUIRE(rows.time().size() == x.size());
    for (const auto& [name, exact] : {std::pair{"m.position", &x}, std::pair{"m.velocity", &v}}) {
      double worst = 0;
      for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(rows[name][i] - (*exact)[i]));
      CAPTURE(name);
      CHECK(worst <= accuracy * rows.scale(name));
    }
  }
}

// Each slider that began to slip started a search through the modes of all sliders.
TEST_CASE("A chain of springs sets sliders moving one after the other") {
  constexpr int cells = 150;
  constexpr double stiffness = 1000, coulomb = 0.002, amplitude = 0.011;
  const std::string text = fmt::format(R"([models.cell]
ports = ["a", "b"]
[models.cell.elements]
k = {{ type = "spring", between = ["a", "b"], stiffness = {} }}
s = {{ type = "slider", between = ["a", "ground"], coulomb = {} }}
[elements]
drive = {{ type = "motion", at = "p", position = {{ sine = {}, frequency = 1 }} }}
chain = {{ type = "cell", between = ["p", "ground"], repeat = {{ count = {} }} }}
[simulate]
stop   = 1
output = {{ points = 102 }}
record = ["chain.force"]
)", stiffness, coulomb, amplitude, cells);
  // With sliders 0 to n in motion their springs carry T + (n - i) Fc, i = 0 .. n, where T <= Fc is what the last one carries. They sum
  // to the stiffness times the displacement of the first.
  const auto first = [](double x) {
    for (int n = 0;; ++n) {
      const double last = (stiffness * x - coulomb * n * (n + 1) / 2) / (n + 1);
      if (last <= coulomb || n == cells - 1) return coulomb + last + n * coulomb;
    }
  };
  // At each return the whole chain goes twice as far with twice the forces (Masing).
  const auto force = [&](double t) {
    const double x = amplitude * std::sin(2 * pi * t);
    if (t <= 0.25) return first(x);
    if (t <= 0.75) return first(amplitude) - 2 * first((amplitude - x) / 2);
    return -first(amplitude) + 2 * first((x + amplitude) / 2);
  };
  CHECK(first(amplitude) < cells * coulomb);  // some are never reached
  const double begin = cpu_time();
  check_between(text, {{"chain.force", force}}, {0, 0.25, 0.75});
  CHECK(cpu_time() - begin < 30);
}

}  // namespace rheonet::test::large_scenes_test
