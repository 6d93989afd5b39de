#include "tests/support/power_balance.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/network/component.hpp"
#include "core/result/run.hpp"

namespace rheonet::test {

namespace {

const Component& component_of(const SceneElement& element) { return *components()[static_cast<std::size_t>(element.declaration)]; }

/// Its power is supplied to the network, not taken from it.
bool supplies(const Component& component) { return component.role == Role::motion || (component.role == Role::force && !component.declaration.resists); }

}  // namespace

std::vector<std::vector<double>> power_rows(Scene scene, int intervals) {
  using Channel = Record::Channel;
  scene.output_events = false;
  scene.output_intervals = intervals;
  scene.output_every = (scene.stop - scene.start) / intervals;
  scene.records.clear();
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    for (const auto& [name, channel] : {std::pair{".power", Channel::power}, {".dissipated", Channel::dissipated}, {".energy", Channel::energy}})
      scene.records.push_back({scene.elements[e].name + name, Record::Subject::element, static_cast<int>(e), channel});
  }
  std::vector<std::vector<double>> rows;
  RunSettings settings;
  settings.row = [&](double, const std::vector<double>& values) { rows.push_back(values); };
  run(scene, settings);
  return rows;
}

void check_storage(const Scene& scene, const std::vector<std::vector<double>>& rows, double allowed) {
  constexpr double corners = 0.05;  // share of the pairs that do not count
  const double every = (scene.stop - scene.start) / static_cast<double>(rows.size() - 1);
  for (std::size_t e = 0; e < scene.elements.size(); ++e) {
    const SceneElement& element = scene.elements[e];
    if (supplies(component_of(element)) || component_of(element).role == Role::block) continue;
    std::vector<double> defects;
    double turnover = 0, energy = 0;
    for (std::size_t k = 0; k + 2 < rows.size(); k += 2) {
      const auto left = [&](std::size_t i) { return rows[i][3 * e] - rows[i][3 * e + 1]; };
      const double stored = rows[k + 2][3 * e + 2] - rows[k][3 * e + 2];
      defects.push_back(std::abs(stored - every / 3 * (left(k) + 4 * left(k + 1) + left(k + 2))));
      turnover += 2 * every * std::abs(rows[k + 1][3 * e]);
      energy = std::max(energy, std::abs(rows[k][3 * e + 2]));
    }
    std::sort(defects.begin(), defects.end());
    defects.resize(static_cast<std::size_t>(static_cast<double>(defects.size()) * (1 - corners)));
    double sum = 0;
    for (const double defect : defects) sum += defect;
    CHECK_MESSAGE(sum <= allowed * (turnover + energy), fmt::format("{} ({}): {:.3g} J of {:.3g} J are neither stored nor dissipated", element.name,
                                                                    component_of(element).declaration.type, sum, turnover + energy));
  }
}

void check_supply(const Scene& scene, const std::vector<std::vector<double>>& rows, double allowed) {
  double largest = 0, worst = 0;
  for (const std::vector<double>& row : rows) {
    double sum = 0, magnitude = 0;
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      sum += (supplies(component_of(scene.elements[e])) ? 1 : -1) * row[3 * e];
      magnitude += std::abs(row[3 * e]);
    }
    largest = std::max(largest, magnitude);
    worst = std::max(worst, std::abs(sum));
  }
  CHECK_MESSAGE(worst <= allowed * largest, fmt::format("{:.3g} W of {:.3g} W are supplied by nothing", worst, largest));
}

}  // namespace rheonet::test
