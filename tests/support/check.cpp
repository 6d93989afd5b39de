#include "tests/support/check.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rheonet::test {

namespace {
// Errors may be this many times the accuracy asked for.
constexpr double margin = 10;
}  // namespace

void check_against(const RunTable& trajectory, const Expectation& expected, double accuracy) {
  const std::vector<double>& time = trajectory.time();
  const std::vector<double>& computed = trajectory[expected.column];
  REQUIRE_GT(time.size(), 1);
  REQUIRE_EQ(time.size(), computed.size());

  double scale = expected.scale;
  std::vector<double> exact(time.size());
  for (std::size_t row = 0; row < time.size(); ++row) {
    exact[row] = expected.exact(time[row]);
    scale = std::max(scale, std::abs(exact[row]));
  }
  const double tolerance = margin * accuracy * scale;
  double worst = -1;
  std::size_t at = 0;
  for (std::size_t row = 0; row < time.size(); ++row) {
    double error = std::abs(computed[row] - exact[row]);
    if (std::isnan(error)) error = HUGE_VAL;
    if (error > worst) worst = error, at = row;
  }
  CHECK_MESSAGE(
      worst <= tolerance,
      fmt::format("{} at accuracy {:g}: row {} (t = {:.9g} s) has {:.12g}, exact is {:.12g}: off by {:.3g}, {:.3g} "
                  "times the accuracy (up to {:g} is allowed)",
                  expected.column, accuracy, at, time[at], computed[at], exact[at], worst, worst / (accuracy * scale),
                  margin));
}

void check_at_all_accuracies(const std::string& toml, const Expectations& expected) {
  INFO(toml);
  for (const double accuracy : accuracies) {
    try {
      const RunTable trajectory = simulate(toml, accuracy);
      for (const Expectation& one : expected) check_against(trajectory, one, accuracy);
    } catch (const std::runtime_error& refused) {
      FAIL_CHECK(fmt::format("at accuracy {:g}: {}", accuracy, refused.what()));
    }
  }
}

void check_against_closer(const std::string& toml, double accuracy, const std::vector<std::string>& columns, double closest) {
  INFO(toml);
  const RunTable run = simulate(toml, accuracy), closer = simulate(toml, closest);
  for (const std::string& column : columns) {
    std::size_t row = 0;
    REQUIRE_EQ(run.time(), closer.time());
    check_against(run, {column, [&](double) { return closer[column][row++]; }}, accuracy);
  }
}

Exact from(double start, Exact after, double before) {
  return [=](double t) { return t < start ? before : after(t - start); };
}

std::string netlist(Named parameters, std::string_view tables, double stop, int rows) {
  std::string text = "[parameters]\n";
  for (const auto& [name, value] : parameters) text += fmt::format("{} = {:.17g}\n", name, value);
  text += tables;
  return text + fmt::format("\n[simulate]\nstop = {:.17g}\noutput = {{ points = {} }}\n", stop, rows);
}

std::string record(const Expectations& expected) {
  std::string names;
  for (const Expectation& one : expected) names += fmt::format("\"{}\", ", one.column);
  return "record = [" + names + "]\n";
}

}  // namespace rheonet::test
