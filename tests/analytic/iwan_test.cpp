// Iwan bundles on a driven mass: N springs in series with sliders, side by side, against a solution from kink to kink.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>

#include "tests/analytic/slider_checks.hpp"
#include "tests/support/iwan_oscillator.hpp"
#include "tests/support/scene_file.hpp"

namespace rheonet::test::iwan_test {

namespace {

// Of tools/bench/iwan.toml.
constexpr double mass = 1, force = 8, frequency = 1, K = 400, FC = 10, stop = 3;

std::vector<IwanOscillator::Pair> pairs(int n) {
  std::vector<IwanOscillator::Pair> result;
  for (int i = 0; i < n; ++i) result.push_back({K / n, 2 * FC * (i + 0.5) / (double(n) * n)});
  return result;
}

/// The bundle that the benchmark is about, with another number of pairs.
SceneFile run_bundle(int n, double accuracy, std::vector<std::string> overrides = {}) {
  overrides.push_back(fmt::format("iwan.repeat.count={}", n));
  overrides.push_back(fmt::format("simulate.accuracy={}", accuracy));
  return run_file("../tools/bench/iwan.toml", overrides);
}

void check_position(int n, double accuracy) {
  CAPTURE(n);
  CAPTURE(accuracy);
  const SceneFile run = run_bundle(n, accuracy, {R"(simulate.record=["x.position", "x.velocity"])"});
  IwanOscillator exact(mass, force, frequency, pairs(n));
  std::vector<double> x, v;
  for (double t : run.rows.time()) {
    exact.advance(t);
    x.push_back(exact.position());
    v.push_back(exact.velocity());
  }
  const auto row = [&](double t) { return std::size_t(std::round(t * double(x.size() - 1) / stop)); };
  check_against(run.rows, {"x.position", [&](double t) { return x[row(t)]; }}, accuracy);
  check_against(run.rows, {"x.velocity", [&](double t) { return v[row(t)]; }}, accuracy);
  const rheonet::Summary& s = run.summary;
  CHECK(std::abs(s.dissipated - exact.dissipated()) <= 10 * accuracy * s.largest);
  CHECK(std::abs(s.missing) <= 10 * accuracy * s.largest);
  // Two unknowns whatever n, and no restart at a yield but where a single one counts.
  CHECK_EQ(s.unknowns, 2);
  if (n > 33) CHECK_LE(s.restarts, 20);
  // Yet all yields are counted, up to one near the end of a half cycle.
  const auto told = double(s.events), true_ones = double(exact.history().size());
  CHECK_LE(std::abs(told - true_ones), 2 + 1e-3 * true_ones);
}

struct Told {
  double t;
  std::string element, what;
  int direction;
};

std::vector<Told> events_of(const rheonet::Scene& scene) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  rheonet::run(scene, {.events = file.get(), .interrupt = nullptr, .progress = {}});
  std::string text;
  std::rewind(file.get());
  for (int c; (c = std::fgetc(file.get())) != EOF;) text.push_back(char(c));
  std::istringstream in(text);
  std::string cell;
  std::getline(in, cell);
  std::vector<Told> result;
  while (std::getline(in, cell, ',')) {
    Told told{std::strtod(cell.c_str(), nullptr), "", "", 0};
    std::getline(in, told.element, ',');
    std::getline(in, told.what, ',');
    std::getline(in, cell);
    told.direction = std::atoi(cell.c_str());
    result.push_back(told);
  }
  return result;
}

}  // namespace

TEST_CASE("Iwan bundle on a driven mass: 1 to 100,000 pairs, at all accuracies") {
  for (const int n : {1, 2, 3, 10, 30, 100, 1000}) {
    for (const double accuracy : accuracies) check_position(n, accuracy);
  }
  check_position(10000, 1e-6);
  check_position(100000, 1e-6);
}

TEST_CASE("Iwan bundle: each spring and slider is recorded as if it were alone") {
  for (const int n : {3, 40}) {
    for (const double accuracy : accuracies) {
      CAPTURE(n);
      CAPTURE(accuracy);
      const SceneFile run = run_bundle(n, accuracy, {"simulate.output.points=61"});
      IwanOscillator exact(mass, force, frequency, pairs(n));
      const auto k = std::size_t(n / 3);
      const std::string name = fmt::format("iwan.{}", k);
      const double stiffness = K / n, largest = FC, longest = run.rows.scale("x.position");
      for (std::size_t row = 0; row < run.rows.time().size(); ++row) {
        exact.advance(run.rows.time()[row]);
        const double f = exact.force(k), x = exact.position(), w = exact.velocity();
        const auto near = [&](const std::string& column, double value, double scale) {
          CHECK_MESSAGE(std::abs(run.rows[column][row] - value) <= 10 * accuracy * scale,
                        column << " is " << run.rows[column][row] << ", not " << value);
        };
        near(name + ".k.force", f, largest / n);
        near(name + ".s.force", f, largest / n);
        near(name + ".force", f, largest / n);
        near(name + ".k.displacement", f / stiffness, longest);
        near(name + ".s.displacement", x - f / stiffness, longest);
        near(name + ".node1.position", x - f / stiffness, longest);
        near(name + ".displacement", x, longest);
        near(name + ".s.velocity", exact.slips(k) ? w : 0, run.rows.scale("x.velocity"));
        near(name + ".k.velocity", exact.slips(k) ? 0 : w, run.rows.scale("x.velocity"));
        near(name + ".node1.velocity", exact.slips(k) ? w : 0, run.rows.scale("x.velocity"));
        double sum = 0;
        for (std::size_t i = 0; i < std::size_t(n); ++i) {
          sum += exact.force(i);
          CHECK(std::abs(run.rows[fmt::format("iwan.{}.s.force", i)][row]) <=
                2 * FC * (double(i) + 0.5) / (double(n) * n));
        }
        near("iwan.force", sum, largest);
      }
    }
  }
}

TEST_CASE("Iwan bundle: every yield is told of at its time, though few are events of the integrator") {
  for (const int n : {5, 60}) {
    CAPTURE(n);
    constexpr double accuracy = 1e-9, longest = 0.05;
    const std::vector<Told> told = events_of(run_bundle(n, accuracy).scene);
    IwanOscillator exact(mass, force, frequency, pairs(n));
    exact.advance(stop);
    REQUIRE_EQ(told.size(), exact.history().size());
    CHECK(std::is_sorted(told.begin(), told.end(), [](const Told& a, const Told& b) { return a.t < b.t; }));
    // The order of sticks at the same instant is arbitrary, so compare the events of each element separately.
    for (int i = 0; i < n; ++i) {
      std::vector<Told> mine;
      std::vector<IwanOscillator::Yield> expected;
      for (const Told& one : told) {
        if (one.element == fmt::format("iwan.{}.s", i)) mine.push_back(one);
      }
      for (const IwanOscillator::Yield& one : exact.history()) {
        if (one.pair == std::size_t(i)) expected.push_back(one);
      }
      REQUIRE_EQ(mine.size(), expected.size());
      for (std::size_t j = 0; j < mine.size(); ++j) {
        // Where the mass is slow an error of its position is a long time.
        const double slow = expected[j].velocity == 0 ? 0 : longest / std::abs(expected[j].velocity);
        CHECK(std::abs(mine[j].t - expected[j].t) <= 10 * accuracy * (stop + slow));
        CHECK_EQ(mine[j].what, expected[j].direction == 0 ? "stick" : "slip");
        CHECK_EQ(mine[j].direction, expected[j].direction);
      }
    }
  }
}

TEST_CASE("Iwan bundle: with rows at every event each yield has its own") {
  constexpr int n = 50;
  const SceneFile run =
      run_bundle(n, 1e-6, {"simulate.output.events=true", R"(simulate.record=["x.position"])"});
  IwanOscillator exact(mass, force, frequency, pairs(n));
  exact.advance(stop);
  std::vector<double> instants;
  for (const IwanOscillator::Yield& one : exact.history()) {
    if (instants.empty() || one.t > instants.back()) instants.push_back(one.t);
  }
  CHECK_EQ(run.rows.time().size(), 31 + 2 * instants.size());
}

TEST_CASE("Iwan bundle: forces at the start, given or from where the nodes start") {
  constexpr int n = 12;
  constexpr double x0 = 0.0217;
  for (const bool by_place : {false, true}) {
    for (const double accuracy : accuracies) {
      CAPTURE(by_place);
      CAPTURE(accuracy);
      std::vector<IwanOscillator::Pair> with = pairs(n);
      std::string toml = fmt::format("[elements]\nm = {{ type = \"mass\", at = \"x\", mass = {} }}\n", mass);
      toml += fmt::format("f = {{ type = \"force\", at = \"x\", force = {{ sine = {}, frequency = {} }} }}\n", force,
                          frequency);
      std::string nodes = fmt::format("[nodes]\nx = {{ position = {:.17g} }}\n", x0);
      for (int i = 0; i < n; ++i) {
        IwanOscillator::Pair& pair = with[std::size_t(i)];
        // Beyond its bound it slides before anything else happens.
        const double f = pair.coulomb * (1.3 * std::sin(1.7 * i + 0.3));
        pair.force = std::clamp(f, -pair.coulomb, pair.coulomb);
        // Either end first, with or without a rest of its own.
        const double rest = i % 3 == 0 ? 0 : 0.0031 * i;
        std::string start = by_place ? fmt::format(", rest = {:.17g}", i % 2 ? rest : -rest)
                                     : fmt::format(", f0 = {:.17g}", i % 2 ? f : -f);
        toml += fmt::format("k{} = {{ type = \"spring\", between = [{}], stiffness = {:.17g}{} }}\n", i,
                            i % 2 ? fmt::format("\"x\", \"n{}\"", i) : fmt::format("\"n{}\", \"x\"", i), pair.stiffness,
                            start);
        toml += fmt::format("s{} = {{ type = \"slider\", between = [{}], coulomb = {:.17g} }}\n", i,
                            i % 3 ? fmt::format("\"n{}\", \"ground\"", i) : fmt::format("\"ground\", \"n{}\"", i),
                            pair.coulomb);
        if (by_place) nodes += fmt::format("n{} = {{ position = {:.17g} }}\n", i, x0 - rest - f / pair.stiffness);
      }
      toml += nodes + fmt::format("[simulate]\nstop = {}\noutput = {{ points = 41 }}\n", stop);
      const Outcome run = outcome(toml, accuracy);
      IwanOscillator exact(mass, force, frequency, with);
      const double longest = run.rows.scale("x.position") - x0;
      for (std::size_t row = 0; row < run.rows.time().size(); ++row) {
        exact.advance(run.rows.time()[row]);
        CHECK(std::abs(run.rows["x.position"][row] - x0 - exact.position()) <= 10 * accuracy * longest);
        for (const int i : {3, 4, 7}) {
          const double f = exact.force(std::size_t(i)), sign = i % 2 ? 1 : -1;
          CHECK(std::abs(run.rows[fmt::format("k{}.force", i)][row] - sign * f) <= 10 * accuracy * FC);
          // The three displacements add up, whatever the start.
          const double x = run.rows["x.position"][row], node = run.rows[fmt::format("n{}.position", i)][row];
          CHECK(run.rows[fmt::format("k{}.displacement", i)][row] == doctest::Approx(sign * (x - node)).epsilon(1e-9));
          const double slide = (i % 3 ? 1 : -1) * node;
          CHECK(run.rows[fmt::format("s{}.displacement", i)][row] == doctest::Approx(slide).epsilon(1e-9));
        }
      }
      CHECK(std::abs(run.summary.missing) <= 10 * accuracy * run.summary.largest);
    }
  }
}

}  // namespace rheonet::test::iwan_test
