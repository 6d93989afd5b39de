// Every scene that comes with the project keeps its claims and closed forms if each of its drives acts through a gear.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/index.hpp"
#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/trajectory.hpp"
#include "tests/support/transform.hpp"

namespace rheonet::test::behind_gears_test {

namespace {

const std::filesystem::path folder_of_scenes = RHEONET_SOURCE_DIR "/netlists";

bool of_drive(const Scene& scene, const Record& record) {
  bool found = false;
  for_each_operand(scene, record, [&](const Record& operand) {
    if (operand.subject == Record::Subject::element) found = found || test::drives(scene.elements[at(operand.index)]);
  });
  return found;
}

}  // namespace

TEST_CASE("every scene keeps its claims and closed forms with its drives behind gears") {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_of_scenes)) {
    const auto relative = std::filesystem::relative(entry.path(), folder_of_scenes);
    if (entry.path().extension() == ".toml" && *relative.begin() != "library" && *relative.begin() != "hard") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    CAPTURE(file.string());
    ReadOptions options;
    options.model_folders = {folder_of_scenes};
    const ReadResult read = read_scene(file, declarations(), options);
    REQUIRE(read.scene);
    const Scene& scene = *read.scene;
    Trajectory rows;
    CHECK_NOTHROW(rows = run_to_memory(test::behind_gears(scene, -1.7)));
    const Summary& summary = rows.summary;
    for (std::size_t i = 0; i < summary.findings.size(); ++i) {
      const Claim& claim = scene.claims[i];
      if (of_drive(scene, scene.claimed[at(claim.record)]) || (claim.per >= 0 && of_drive(scene, scene.claimed[at(claim.per)]))) continue;
      CHECK_MESSAGE(summary.findings[i].holds, fmt::format("line {}: {:.10g}", claim.spot.line, summary.findings[i].found));
    }
    for (const ExactRecord& form : scene.exact) {
      if (of_drive(scene, scene.records[at(form.record)])) continue;
      CAPTURE(scene.records[at(form.record)].path);
      double off = 0, scale = 0;
      for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        const double value = form.value(rows.times[i]);
        off = std::max(off, std::abs(rows.rows[i][at(form.record)] - value));
        scale = std::max(scale, std::abs(value));
      }
      CHECK(off <= scene.accuracy * scale);
    }
    CHECK(std::abs(summary.missing) <= 10 * scene.accuracy * summary.largest);
  }
}

}  // namespace rheonet::test::behind_gears_test
