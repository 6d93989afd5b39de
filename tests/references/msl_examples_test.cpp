// Examples of the Modelica Standard Library 4, with values that others have published or that independent integrations give: see msl/README.md.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/base/index.hpp"
#include "core/netlist/read.hpp"
#include "core/network/component.hpp"
#include "core/result/trajectory.hpp"

namespace rheonet::test::msl_examples_test {

TEST_CASE("examples of the Modelica Standard Library keep their published values") {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(RHEONET_SOURCE_DIR "/tests/references/msl")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  REQUIRE(files.size() >= 24);
  for (const auto& file : files) {
    CAPTURE(file.string());
    const ReadResult read = read_scene(file, declarations());
    CHECK(read.diagnostics.empty());
    REQUIRE(read.scene);
    const Summary summary = run_to_memory(*read.scene).summary;
    REQUIRE(summary.findings.size() == read.scene->claims.size());
    CHECK(summary.findings.size() >= 3);
    for (std::size_t i = 0; i < summary.findings.size(); ++i) {
      const Claim& claim = read.scene->claims[i];
      CHECK_MESSAGE(summary.findings[i].holds, fmt::format("line {}, {}: {:.10g}", claim.spot.line, read.scene->claimed[at(claim.record)].path, summary.findings[i].found));
    }
  }
}

}  // namespace rheonet::test::msl_examples_test
