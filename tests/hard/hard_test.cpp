// Every scene of netlists/hard keeps its claims at three accuracies; and what a claim cannot say of some of them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "tests/support/check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene_file.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test::hard_test {

namespace fs = std::filesystem;

namespace {

const fs::path netlists = RHEONET_SOURCE_DIR "/netlists";

std::vector<fs::path> cases() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(netlists / "hard")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Scene scene_of(const fs::path& file, const std::vector<std::string>& overrides = {}) {
  ReadOptions options;
  options.overrides = overrides;
  options.model_folders = {netlists};
  const ReadResult read = read_scene(file, declarations(), options);
  for (const Diagnostic& diagnostic : read.diagnostics) FAIL_CHECK(format(diagnostic, read.sources));
  REQUIRE(read.scene);
  return *read.scene;
}

/// The text after `# KEY:` in the head of a scene; "" if there is none.
std::string said(const fs::path& file, const std::string& key) {
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line) && line.starts_with("#");) {
    const std::size_t colon = line.find(':');
    if (colon != line.npos && line.substr(2, colon - 2) == key) return line.substr(line.find_first_not_of(' ', colon + 1));
  }
  return "";
}

/// Every row of one run is a row of the other, to the last bit.
void check_same_rows(const RunTable& some, const RunTable& all) {
  std::size_t found = 0;
  for (std::size_t row = 0, other = 0; row < some.time().size(); ++row) {
    while (other < all.time().size() && all.time()[other] < some.time()[row]) ++other;
    REQUIRE(other < all.time().size());
    REQUIRE(all.time()[other] == some.time()[row]);
    bool same = true;
    for (const std::string& column : some.header) same = same && some[column][row] == all[column][other];
    found += same;
  }
  CHECK(found == some.time().size());
}

}  // namespace

TEST_CASE("Hard cases: every claim holds at 1e-3, 1e-6 and 1e-9") {
  REQUIRE_GE(cases().size(), 25);
  for (const fs::path& file : cases()) {
    CAPTURE(file.filename().string());
    const std::string shorter = said(file, "short");  // to save time: `tools/hard` runs all of it
    Scene scene = scene_of(file, shorter.empty() ? std::vector<std::string>{} : std::vector{shorter});
    CHECK_FALSE(scene.title.empty());
    CHECK_GT(scene.claims.size(), 1);
    for (const double accuracy : accuracies) {
      CAPTURE(accuracy);
      scene.accuracy = accuracy;
      Summary summary;
      CHECK_NOTHROW(summary = run(scene));
      REQUIRE_EQ(summary.findings.size(), scene.claims.size());
      for (std::size_t i = 0; i < summary.findings.size(); ++i) {
        const Finding& finding = summary.findings[i];
        CHECK_MESSAGE(finding.holds, fmt::format("line {}: {:.12g}, tolerance {:.3g}", scene.claims[i].spot.line,
                                                 finding.found, finding.tolerance));
      }
    }
  }
}

TEST_CASE("Hard cases: each says why it is hard and what must hold, and has an easy twin that runs") {
  for (const fs::path& file : cases()) {
    CAPTURE(file.filename().string());
    for (const char* key : {"hard", "holds", "easy"}) CHECK_FALSE(said(file, key).empty());
    const Folder folder;
    // Its claims are about the hard scene, and may fail.
    const Finished easy = folder.shell("rheonet run -q -o /dev/null '" + file.string() + "' --set " + said(file, "easy"));
    CHECK_MESSAGE(easy.status <= 1, easy.err);
    CHECK_MESSAGE((easy.status == 0 || contains(easy.err, "the claim fails")), easy.err);
  }
}

TEST_CASE("Hard cases: the rows of a run are the same to the last bit, however many others there are") {
  const fs::path file = netlists / "hard/rows-and-steps.toml";
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    const std::string asked = fmt::format("simulate.accuracy={}", accuracy);
    const auto rows = [&](int points) { return simulate(scene_of(file, {asked, fmt::format("simulate.output.points={}", points)})); };
    const RunTable dense = rows(65537);  // intervals are powers of 2 s: all have their times in common
    for (const int points : {3, 17, 1025}) check_same_rows(rows(points), dense);
  }
}

TEST_CASE("Hard cases: ten thousand swings at resonance keep amplitude and phase") {
  Scene scene = scene_of(netlists / "hard/resonance.toml");
  scene.accuracy = 1e-3;
  const Summary summary = run(scene);
  for (const Finding& finding : summary.findings) CHECK(finding.holds);
  CHECK(std::abs(summary.missing) <= 1e-3 * summary.largest);
}

TEST_CASE("Hard cases: laws that come to equal bounds at once share the motion at any accuracy and order") {
  Scene scene = scene_of(netlists / "hard/saturated-in-series.toml");
  for (int order = 2; order <= 5; ++order) {
    for (int digits = 2; digits <= 12; ++digits) {
      CAPTURE(order);
      CAPTURE(digits);
      scene.accuracy = std::pow(10.0, -digits);
      for (const Finding& finding : run(scene, {.order = order}).findings) CHECK(finding.holds);
    }
  }
}

// To rounding, which differs: where a matrix has its pivots goes with the units.
TEST_CASE("Hard cases: one scene in nanometres, in megametres and in SI is the same answer, scaled") {
  for (const double accuracy : accuracies) {
    CAPTURE(accuracy);
    Scene scene = scene_of(netlists / "hard/units.toml",
                           {"parameters.length=1 m", "parameters.time=1 s", "parameters.force=1 N"});
    scene.accuracy = accuracy;
    const RunTable plain = simulate(scene);
    for (const Scaling& units : {Scaling{1e9, 1e9, 1e9}, {1e-6, 1e9, 1e-6}, {1e9, 1e-6, 1e-9}, {0x1p-20, 0x1p-40, 0x1p-10}}) {
      CAPTURE(units.length);
      CAPTURE(units.time);
      const RunTable scaled = simulate(rescaled(scene, units));
      for (const Record& record : scene.records) {
        CAPTURE(record.path);
        const double by = factor(scene, record, units), scale = plain.scale(record.path);
        double off = 0;
        for (std::size_t row = 0; row < plain.time().size(); ++row) {
          off = std::max(off, std::abs(scaled[record.path][row] / by - plain[record.path][row]));
        }
        CHECK_MESSAGE(off <= 1e-11 * scale, fmt::format("{:.3g}", off / scale));
      }
    }
  }
}

TEST_CASE("Hard cases: a mass that goes to 0 comes to what is without one, in proportion") {
  const auto rows = [](double mass) {
    return run_file("hard/mass-to-nothing.toml", {"simulate.accuracy=1e-9", fmt::format("parameters.m={} kg", mass)}).rows;
  };
  const RunTable none = rows(0);
  const auto apart = [&](double mass) {
    const RunTable some = rows(mass);
    double off = 0;
    for (std::size_t row = 0; row < none.time().size(); ++row) off = std::max(off, std::abs(some["k1.force"][row] - none["k1.force"][row]));
    return off / none.scale("k1.force");
  };
  const double light = apart(1e-6), lighter = apart(1e-8);
  CHECK(light == doctest::Approx(1e-6 * 2.9 / (1.3 * 1.3)).epsilon(1));  // the order of m k/c^2
  CHECK(lighter / light == doctest::Approx(0.01).epsilon(0.3));
  CHECK(apart(1e-15) <= 2e-9);
}

TEST_CASE("tools/hard: a line for each case, with three errors, steps and time, and those against its easy twin") {
  const Folder folder;
  const std::string tool = "RHEONET='" RHEONET_PROGRAM "' '" RHEONET_SOURCE_DIR "/tools/hard' ";
  std::istringstream lines(folder.shell(tool + "delay-limit sliders-equal", 0).out);
  std::string line, name;
  std::getline(lines, line);
  CHECK(line.starts_with("case "));
  for (const char* expected : {"delay-limit", "sliders-equal"}) {
    std::getline(lines, line);
    std::istringstream cells(line);
    cells >> name;
    CHECK(name == expected);
    std::vector<double> figures;
    for (double x; cells >> x;) figures.push_back(x);
    REQUIRE(figures.size() == 7);
    for (std::size_t k = 0; k < 3; ++k) CHECK(figures[k] <= 1);
    CHECK((figures[0] > 0) == (name == "delay-limit"));  // the other one is exact
    CHECK(figures[3] >= 10);
    for (std::size_t k = 4; k < 7; ++k) CHECK(figures[k] > 0);
  }
  CHECK_FALSE(std::getline(lines, line));
  CHECK(folder.shell(tool + "no-such-case").status != 0);
}

TEST_CASE("the generated part of netlists/hard/README.md is up to date") {
  const Folder folder;
  const std::string source = RHEONET_SOURCE_DIR;
  const Finished made = folder.shell("'" + source + "/tools/hard' --markdown", 0);
  const std::string page = text_of(source + "/netlists/hard/README.md");
  const std::size_t marker = page.find("<!-- generated by tools/hard");
  REQUIRE_MESSAGE(marker != std::string::npos, "netlists/hard/README.md has lost the marker of its generated part");
  const bool up_to_date = page.substr(marker) == made.out;
  CHECK_MESSAGE(up_to_date, "netlists/hard/README.md is stale; tools/hard says how to bring it up to date");
}

}  // namespace rheonet::test::hard_test
