#include "tests/references/reference.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rheonet::test {

std::optional<std::string> reference_text(const std::string& file) {
  const char* given = std::getenv("RHEONET_REFERENCES");
  const std::filesystem::path folder = given ? given : RHEONET_SOURCE_DIR "/../shared/references";
  std::ifstream stream(folder / file);
  if (!stream) {
    MESSAGE("skipped: no " << (folder / file).string() << " (RHEONET_REFERENCES names the folder)");
    return std::nullopt;
  }
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::optional<RunTable> reference(const std::string& file) {
  const std::optional<std::string> text = reference_text(file);
  if (!text) return std::nullopt;
  std::istringstream lines(*text);
  RunTable result;
  std::string line, cell;
  std::getline(lines, line);
  for (std::istringstream names(line); std::getline(names, cell, ',');) result.header.push_back(cell);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (const std::string& name : result.header) {
      REQUIRE(std::getline(cells, cell, ','));
      result.columns[name].push_back(std::stod(cell));
    }
  }
  return result;
}

void check_reference(const RunTable& ours, const std::string& column, double shift, const RunTable& theirs,
                     const std::string& their_column, double every, double tolerance) {
  const std::vector<double>&computed = ours[column], &expected = theirs[their_column];
  const auto [least, greatest] = std::minmax_element(expected.begin(), expected.end());
  const double range = *greatest > *least ? *greatest - *least : 1;
  double worst = 0, at = 0;
  for (std::size_t row = 0; row < expected.size(); ++row) {
    const double t = theirs.time()[row];
    const auto index = std::size_t(std::lround(t / every));
    REQUIRE_LT(index, computed.size());
    REQUIRE_LT(std::abs(ours.time()[index] - t), 1e-9);
    const double error = std::abs(shift + computed[index] - expected[row]);
    if (!(error <= worst)) worst = error, at = t;
  }
  CHECK_MESSAGE(worst <= tolerance * range,
                fmt::format("{} against {}: off by {:.3g} of its range {:.6g} at t = {:g} s", column, their_column,
                            worst / range, range, at));
}

}  // namespace rheonet::test
