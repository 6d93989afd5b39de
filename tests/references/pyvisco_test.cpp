// A generalised Maxwell network of 31 branches under a step of strain, with the time constants of a measured material
// over 30 decades: the Prony series of NREL's pyvisco, and the measurement that it was fitted to.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "tests/references/reference.hpp"

namespace rheonet::test::pyvisco_test {

namespace {

constexpr double E0 = 1739.03;  // MPa, the modulus at once
constexpr double fit = 9.1;     // MPa, how far the series is from the measurement
constexpr double accuracies[] = {1e-3, 1e-6, 1e-9};

/// Pairs g, tau: the numbers after "TBDATA,<number of the first>", one after another.
std::vector<std::pair<double, double>> read_terms(const std::string& text) {
  std::vector<double> values;
  std::istringstream lines(text);
  for (std::string line, cell; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::getline(cells, cell, ',');
    if (cell != "TBDATA") continue;
    std::getline(cells, cell, ',');
    while (std::getline(cells, cell, ',')) values.push_back(std::stod(cell));
  }
  std::vector<std::pair<double, double>> terms;
  for (std::size_t j = 0; j + 1 < values.size(); j += 2) terms.emplace_back(values[j], values[j + 1]);
  return terms;
}

double modulus(const std::vector<std::pair<double, double>>& terms, double t) {
  double sum = 1;
  for (const auto& [g, tau] : terms) sum += g * std::expm1(-t / tau);
  return E0 * sum;
}

/// A strain of 1 from the start, for a time `stop`; forces stand for stresses in MPa.
std::string scene(const std::vector<std::pair<double, double>>& terms, double stop) {
  double rest = 1;
  std::string branches;
  for (const auto& [g, tau] : terms) {
    rest -= g;
    branches += fmt::format(
        "  {{ series = [ {{ type = \"spring\", stiffness = {:.17g} }}, {{ type = \"dashpot\", damping = {:.17g} }} ] "
        "}},\n",
        E0 * g, E0 * g * tau);
  }
  return fmt::format(R"(
[elements.strain]
type = "motion"
at = "end"
position = {{ step = 1 }}
[elements.material]
between = ["end", "ground"]
parallel = [
  {{ type = "spring", stiffness = {:.17g} }},
{}]
[simulate]
stop = {:.17g}
output = {{ points = 2 }}
record = ["material.force"]
)",
                     E0 * rest, branches, stop);
}

}  // namespace

TEST_CASE("pyvisco: relaxation over 30 decades") {
  const auto prony = reference_text("pyvisco-prony-terms.txt");
  const auto measured = reference_text("pyvisco-relaxation-measured.csv");
  if (!prony || !measured) return;
  const auto terms = read_terms(*prony);
  REQUIRE_EQ(terms.size(), 31);

  for (const double accuracy : accuracies) {
    for (int decade = -3; decade <= 29; ++decade) {
      const double stop = 3.7 * std::pow(10, decade);
      CAPTURE(accuracy);
      CAPTURE(stop);
      const RunTable run = simulate(scene(terms, stop), accuracy);
      CHECK_LE(std::abs(run["material.force"].front() - E0), 10 * accuracy * E0);
      CHECK_LE(std::abs(run["material.force"].back() - modulus(terms, stop)), 10 * accuracy * E0);
    }
  }

  std::istringstream lines(*measured);
  int points = 0;
  for (std::string line; std::getline(lines, line); ++points) {
    if (line.empty() || line[0] == '/' || points % 8 != 0) continue;  // the rest lies as densely as these
    const std::size_t comma = line.find(',');
    const double t = std::stod(line), E = std::stod(line.substr(comma + 1));
    CAPTURE(t);
    CHECK_LE(std::abs(simulate(scene(terms, t), 1e-6)["material.force"].back() - E), fit);
  }
  CHECK_GT(points, 400);
}

}  // namespace rheonet::test::pyvisco_test
