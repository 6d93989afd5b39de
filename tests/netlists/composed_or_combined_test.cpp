// The page for teachers does what it says: its commands end as they should, and its figures are theirs.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>

#include "tests/support/page.hpp"
#include "tests/support/program.hpp"

using namespace rheonet::test;
namespace fs = std::filesystem;

namespace {

const fs::path source(RHEONET_SOURCE_DIR);
const std::string enter = "cd netlists/thesis/compare\n";

/// With a copy of the netlists.
struct Project : Folder {
  Project() { fs::copy(source / "netlists", path() / "netlists", fs::copy_options::recursive); }
};

}  // namespace

// A command whose line ends in `# exit status 1` ends so, any other with 0. A text block, and every figure such
// as 1.39e-01 in what follows, is part of what the commands of the last block have printed.
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
  const Project project;
  project.shell(enter +
                    "rheonet compare cfm.toml sfm-dashpot-series.toml -o table.csv "
                    "--vary parameters.B='1e3 dyn*cm*s/rad:1e6 dyn*cm*s/rad:9:log'",
                0);
  std::istringstream rows(project.read("netlists/thesis/compare/table.csv"));
  std::string line;
  std::getline(rows, line);
  int count = 0;
  for (double B, largest, relative; std::getline(rows, line); ++count) {
    REQUIRE(std::sscanf(line.c_str(), "%lf dyn*cm*s/rad,%lf,%lf,", &B, &largest, &relative) == 3);
    const double b = std::min(1.0, B * 1.5 / 1e5);
    // The rows are T1/100 apart: the largest of them is less by up to a few millionths.
    CHECK(relative == doctest::Approx(std::pow(std::sqrt(1 + b) - 1, 2) / b).epsilon(3e-5));
  }
  CHECK(count == 9);
}

TEST_CASE("CFM against SFM beside a dashpot: at least half of the torque apart at any steady rate") {
  const Project project;
  project.shell(enter +
                    "rheonet compare cfm.toml sfm-dashpot-parallel.toml -o table.csv --set parameters.after=rate "
                    "--vary parameters.rate='0.01 rad/s:400 rad/s:12:log'",
                0);
  std::istringstream rows(project.read("netlists/thesis/compare/table.csv"));
  std::string line;
  std::getline(rows, line);
  for (double rate, largest, relative; std::getline(rows, line);) {
    REQUIRE(std::sscanf(line.c_str(), "%lf rad/s,%lf,%lf,", &rate, &largest, &relative) == 3);
    const double viscous = 5e4 * rate, solid = 1e5;
    CHECK(relative == doctest::Approx(std::max(viscous, solid) / (viscous + solid)).epsilon(1e-6));
    CHECK(relative >= 0.5);
  }
}
