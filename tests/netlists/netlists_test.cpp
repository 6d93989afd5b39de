// Every scene that comes with the project runs, and what it claims holds.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/course.hpp"

using namespace rheonet;

namespace {

const std::filesystem::path folder = RHEONET_SOURCE_DIR "/netlists";

// A library holds models, not scenes; library_test.cpp runs those, tests/hard the hard cases.
std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto relative = std::filesystem::relative(entry.path(), folder);
    if (entry.path().extension() == ".toml" && *relative.begin() != "library" && *relative.begin() != "hard") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Records are what their scene says they are, to its accuracy.
void check_closed_forms(const Scene& scene, const Course& course) {
  for (const ExactRecord& form : scene.exact) {
    const std::size_t k = static_cast<std::size_t>(form.record);
    CAPTURE(scene.records[k].path);
    double off = 0, scale = 0;
    for (std::size_t i = 0; i < course.rows.size(); ++i) {
      const double value = form.value(course.times[i]);
      REQUIRE(std::isfinite(value));
      off = std::max(off, std::abs(course.rows[i][k] - value));
      scale = std::max(scale, std::abs(value));
    }
    CHECK(off <= scene.accuracy * scale);
  }
}

}  // namespace

TEST_CASE("Every netlist of the project runs, and its claims hold") {
  REQUIRE_GE(scenes().size(), 9);
  for (const std::filesystem::path& file : scenes()) {
    CAPTURE(file.string());
    ReadOptions options;
    options.model_folders = {folder};
    const ReadResult read = read_scene(file, declarations(), options);
    for (const Diagnostic& diagnostic : read.diagnostics) FAIL_CHECK(format(diagnostic, read.sources));
    if (!read.scene) continue;
    CHECK_FALSE(read.scene->title.empty());
    CHECK_GE(read.scene->output_intervals, 100);
    if (*std::filesystem::relative(file, folder).begin() == "thesis") CHECK_FALSE(read.scene->claims.empty());
    Course course;
    CHECK_NOTHROW(course = run_to_memory(*read.scene));
    check_closed_forms(*read.scene, course);
    const Summary& summary = course.summary;
    CHECK_GT(summary.steps, 0);
    for (std::size_t i = 0; i < summary.findings.size(); ++i)
      CHECK_MESSAGE(summary.findings[i].holds,
                    fmt::format("line {}: {:.10g}", read.scene->claims[i].spot.line, summary.findings[i].found));
    CHECK_LE(std::abs(summary.missing), 10 * read.scene->accuracy * summary.largest);
  }
}
