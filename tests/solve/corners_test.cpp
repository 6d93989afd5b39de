// A measured signal has a corner at each of its samples. Corners that are smaller than the error of a step cost no restart.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/result/run.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test::corners_test {

namespace {

constexpr double m = 1.3, c = 2.7, k = 210;  // kg, N s/m, N/m
constexpr int rows = 41;

/// A sine as a recorder takes it: so many samples of three periods in 2 s.
std::vector<double> samples(int count) {
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(37 * std::sin(3 * 2 * std::numbers::pi * i / count));
  return values;
}

std::string table(const std::vector<double>& values, bool smooth = false) {
  std::string points;
  const auto count = static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) points += fmt::format("[{}, {}], ", 2 * static_cast<double>(i) / count, values[i]);
  return "{ table = [" + points + (smooth ? "], smooth = true }" : "] }");
}

Scene pushed(const std::vector<double>& values, double accuracy) {
  return scene_of(fmt::format(R"([elements]
push = {{ type = "force", at = "body", force = {} }}
body = {{ type = "mass", at = "body", mass = {} }}
k1 = {{ type = "spring", between = ["body", "ground"], stiffness = {} }}
c1 = {{ type = "dashpot", between = ["body", "ground"], damping = {} }}
[simulate]
stop = 2
accuracy = {}
output = {{ points = {} }}
record = ["body.position"]
)", table(values), m, k, c, accuracy, rows));
}

/// Places of the body at the rows, by Runge and Kutta's method of fourth order from sample to sample.
std::vector<double> places(const std::vector<double>& values) {
  constexpr int parts = 20;
  const std::size_t count = values.size() - 1;
  const double h = 2 / static_cast<double>(count) / parts;
  double x = 0, v = 0;
  std::vector<double> result{0};
  for (std::size_t i = 0; i < count; ++i) {
    for (int j = 0; j < parts; ++j) {
      const auto force = [&](double share) { return values[i] + (values[i + 1] - values[i]) * (j + share) / parts; };
      const auto pull = [&](double place, double speed, double share) { return (force(share) - c * speed - k * place) / m; };
      const double a1 = pull(x, v, 0), v2 = v + h / 2 * a1;
      const double a2 = pull(x + h / 2 * v, v2, 0.5), v3 = v + h / 2 * a2;
      const double a3 = pull(x + h / 2 * v2, v3, 0.5), v4 = v + h * a3;
      const double a4 = pull(x + h * v3, v4, 1);
      x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    if ((i + 1) % (count / (rows - 1)) == 0) result.push_back(x);
  }
  return result;
}

}  // namespace

TEST_CASE("corners that the accuracy cannot see cost no restart") {
  const std::vector<double> values = samples(4000), expected = places(values);
  const double scale = std::abs(*std::max_element(expected.begin(), expected.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (const double accuracy : {1e-3, 1e-6, 1e-9}) {
    CAPTURE(accuracy);
    double off = 0;
    std::size_t row = 0;
    const Summary summary = run(pushed(values, accuracy), {.row = [&](double, const std::vector<double>& r) { off = std::max(off, std::abs(r[0] - expected.at(row++))); }});
    CHECK(row == rows);
    CHECK(off <= accuracy * scale);
    // At tighter accuracies the corners are seen.
    if (accuracy < 1e-3) continue;
    CHECK(summary.restarts < 4000 / 50);
    CHECK(summary.steps < 1.2 * 4000);
  }
}

TEST_CASE("a smooth table of a measured signal costs about the steps of the signal itself") {
  const auto run_with = [](const std::string& signal, const std::string& kind, double accuracy) {
    return run(scene_of(fmt::format(R"([elements]
hand = {{ type = "motion", at = "grip", {} = {} }}
k1 = {{ type = "spring", between = ["grip", "body"], stiffness = {} }}
oil = {{ type = "dashpot", between = ["grip", "body"], damping = {} }}
body = {{ type = "mass", at = "body", mass = {} }}
rub = {{ type = "slider", between = ["body", "ground"], coulomb = 400 }}
[simulate]
stop = 2
method = "ida"
accuracy = {}
record = ["body.position"]
)", kind, signal, k, c, m, accuracy)));
  };
  const std::string smooth = table(samples(20000), true), sine = "{ sine = 37, frequency = 1.5 }";
  for (const char* kind : {"position", "velocity"}) {
    for (const double accuracy : {1e-3, 1e-6}) {
      CAPTURE(kind);
      CAPTURE(accuracy);
      const Summary of_table = run_with(smooth, kind, accuracy), of_sine = run_with(sine, kind, accuracy);
      CHECK(of_table.steps <= 3 * of_sine.steps);
      CHECK(of_table.events == of_sine.events + 1);  // the end of the table
    }
  }
}

TEST_CASE("a corner that the accuracy sees restarts the integrator") {
  // The corners of a triangle, as a velocity of one end of the dashpot: what it pulls goes on smoothly, its force does not.
  const Summary summary = run(scene_of(R"([elements]
hand = { type = "motion", at = "grip", position = { triangle = 0.04, frequency = 1.7 } }
oil = { type = "dashpot", between = ["grip", "body"], damping = 31 }
body = { type = "mass", at = "body", mass = 1.3 }
k1 = { type = "spring", between = ["body", "ground"], stiffness = 210 }
[simulate]
stop = 2
record = ["body.position"]
)"));
  CHECK(summary.restarts == 8);
}

}  // namespace rheonet::test::corners_test
