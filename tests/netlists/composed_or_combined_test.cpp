// The page for teachers does what it says: its commands end as they should, and its figures are theirs.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>
#include <vector>

#include "tests/support/page.hpp"
#include "tests/support/program.hpp"

namespace rheonet::test::composed_or_combined_test {

namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR);
const std::string enter = "cd netlists/thesis/compare\n";

/// With a copy of the netlists.
struct Project : Folder {
  Project() { fs::copy(source / "netlists", path() / "netlists", fs::copy_options::recursive); }
};

struct Row {
  double value, largest, relative;  ///< Value of the varied parameter, and the differences of the scenes.
};

/// The table of `rheonet compare` with these arguments, which vary a parameter of the given unit.
std::vector<Row> compared(const std::string& words, const std::string& unit) {
  const Project project;
  project.shell(enter + "rheonet compare " + words + " -o table.csv", 0);
  std::istringstream lines(project.read("netlists/thesis/compare/table.csv"));
  std::string line;
  std::getline(lines, line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    Row row{};
    REQUIRE(std::sscanf(line.c_str(), ("%lf " + unit + ",%lf,%lf,").c_str(), &row.value, &row.largest, &row.relative) ==
            3);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

// A command whose line ends in `# exit status 1` must end with this status, any other with 0. Each text block, and each figure such as
// 1.39e-01 in the following text, must be in the output of the commands in the last block.
TEST_CASE("every statement of composed-or-combined.md is backed by its command") {
  const Project project;
  const std::regex figure(R"(\d\.\d\de[-+]\d\d)");
  std::string printed;
  int commands = 0, figures = 0;
  for (const Block& part : parts(text_of(source / "netlists/thesis/composed-or-combined.md"))) {
    std::istringstream lines(part.text);
    if (part.language == "sh" && part.text != enter) {
      printed.clear();
      for (std::string line; std::getline(lines, line); ++commands) {
        CAPTURE(line);
        printed += project.shell(enter + line, line.ends_with("# exit status 1") ? 1 : 0).out;
      }
    } else if (part.language == "text") {
      for (std::string line; std::getline(lines, line); ++figures)
        CHECK_MESSAGE(contains(printed, line + "\n"), printed);
    } else if (part.language == "-") {
      for (std::sregex_iterator i(part.text.begin(), part.text.end(), figure), end; i != end; ++i, ++figures)
        CHECK_MESSAGE(contains(printed, i->str()), i->str(), " is not in\n", printed);
    }
  }
  CHECK(commands >= 12);
  CHECK(figures >= 8);
}

TEST_CASE("CFM and its wiring part after a stop by (sqrt(1 + b) - 1)^2/b of the torque there") {
  const auto rows = compared(
      "cfm.toml sfm-dashpot-series.toml --vary parameters.B='1e3 dyn*cm*s/rad:1e6 dyn*cm*s/rad:9:log'",
      "dyn*cm*s/rad");
  CHECK(rows.size() == 9);
  for (const auto& [B, largest, relative] : rows) {
    const double b = std::min(1.0, B * 1.5 / 1e5);
    // The rows are T1/100 apart: the largest of them is less by up to a few millionths.
    CHECK(relative == doctest::Approx(std::pow(std::sqrt(1 + b) - 1, 2) / b).epsilon(3e-5));
  }
}

TEST_CASE("CFM against SFM beside a dashpot: at least half of the torque apart at any steady rate") {
  const auto rows = compared(
      "cfm.toml sfm-dashpot-parallel.toml --set parameters.after=rate "
      "--vary parameters.rate='0.01 rad/s:400 rad/s:12:log'",
      "rad/s");
  CHECK(rows.size() == 12);
  for (const auto& [rate, largest, relative] : rows) {
    const double viscous = 5e4 * rate, solid = 1e5;
    CHECK(relative == doctest::Approx(std::max(viscous, solid) / (viscous + solid)).epsilon(1e-6));
    CHECK(relative >= 0.5);
  }
}

}  // namespace rheonet::test::composed_or_combined_test
