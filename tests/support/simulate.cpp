#include "tests/support/simulate.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"

namespace rheonet::test {
namespace {

// A folder of no project: a scene under test finds nothing beside itself.
const char* const folder_of_text = "/nonexistent";

// Ten times what the scenes of the tests need: a run that would never end is to fail a test, not to stop all.
constexpr long most_steps = 1000000;

std::string contents(std::FILE* file) {
  std::string text;
  char buffer[1 << 14];
  std::rewind(file);
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
  return text;
}

RunTable parse(const std::string& csv) {
  RunTable result;
  std::istringstream lines(csv);
  std::string line, cell;
  std::getline(lines, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) result.header.push_back(cell);
  std::vector<std::vector<double>> columns(result.header.size());
  while (std::getline(lines, line)) {
    const char* next = line.c_str();
    for (std::vector<double>& column : columns) {
      char* end = nullptr;
      column.push_back(std::strtod(next, &end));
      if (end == next) throw std::runtime_error("not a row of numbers: " + line);
      next = *end == ',' ? end + 1 : end;
    }
    if (*next != '\0') throw std::runtime_error("more cells than the header has: " + line);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) result.columns[result.header[i]] = std::move(columns[i]);
  return result;
}

}  // namespace

const std::vector<double>& RunTable::operator[](const std::string& name) const {
  const auto found = columns.find(name);
  REQUIRE_MESSAGE(found != columns.end(), "no column `" << name << "`");
  return found->second;
}

double RunTable::scale(const std::string& name) const {
  double largest = 0;
  for (double x : (*this)[name]) largest = std::max(largest, std::abs(x));
  return largest;
}

double largest_error(const RunTable& rows, const RunTable& exact) {
  REQUIRE(rows.time() == exact.time());
  double largest = 0;
  for (const std::string& name : exact.header) {
    const double scale = exact.scale(name);
    for (std::size_t k = 0; k < exact.time().size(); ++k) {
      const double error = std::abs(rows[name][k] - exact[name][k]);
      if (error > 0) largest = std::max(largest, error / scale);
    }
  }
  return largest;
}

double error_of(const RunTable& rows, const std::string& column, const std::function<double(double)>& exact) {
  double largest = 0, scale = 0;
  for (std::size_t k = 0; k < rows.time().size(); ++k) {
    const double x = exact(rows.time()[k]);
    largest = std::max(largest, std::abs(rows[column][k] - x));
    scale = std::max(scale, std::abs(x));
  }
  return largest / scale;
}

std::string simulate_until(double stop, double accuracy) {
  return fmt::format("[simulate]\nstop = {}\naccuracy = {}\noutput = {{ points = 41 }}\n", stop, accuracy);
}

Scene scene_of(const std::string& toml, double accuracy) {
  ReadOptions options;
  if (accuracy > 0) options.accuracy = accuracy;
  options.model_folders = {std::filesystem::path(RHEONET_SOURCE_DIR) / "netlists"};
  const ReadResult read = read_scene_text(toml, "scene.toml", folder_of_text, declarations(), options);
  if (!read.scene) {
    std::string text;
    for (const Diagnostic& diagnostic : read.diagnostics) text += format(diagnostic, read.sources) + "\n";
    throw std::runtime_error(text);
  }
  return *read.scene;
}

RunTable simulate(const std::string& toml, double accuracy) { return simulate(scene_of(toml, accuracy)); }

RunTable simulate(const Scene& scene, Summary* summary) {
  Attempt result = attempt(scene);
  if (!result.refusal.empty()) throw SimulationError(result.refusal);
  if (summary) *summary = result.summary;
  return std::move(result.rows);
}

Attempt attempt(const Scene& scene) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> csv(std::tmpfile(), &std::fclose);
  if (!csv) throw std::runtime_error("no temporary file");
  long steps = 0;
  const auto count = [&](double fraction) {
    if (++steps <= most_steps) return;
    throw SimulationError("the run gets nowhere: " + std::to_string(steps) + " steps for " + std::to_string(fraction) +
                          " of it");
  };
  Attempt result;
  try {
    result.summary = run(scene, {.csv = csv.get(), .interrupt = nullptr, .progress = count});
  } catch (const SimulationError& error) {
    result.refusal = error.what();
  }
  result.rows = read_rows(csv.get());
  return result;
}

RunTable read_rows(std::FILE* csv) { return parse(contents(csv)); }

std::string refusal(const std::string& toml) {
  try {
    simulate(toml);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace rheonet::test
