#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "core/network/component.hpp"
#include "tests/netlist/reading.hpp"

namespace rheonet::test::readme_test {

TEST_CASE("every example of the reference of the format is a scene") {
  const std::filesystem::path root = RHEONET_SOURCE_DIR;
  std::ifstream stream(root / "core" / "netlist" / "README.md");
  std::stringstream content;
  content << stream.rdbuf();
  const std::string text = content.str();
  const std::string fence = "```toml";
  int examples = 0;
  for (std::size_t at = text.find(fence); at != text.npos; at = text.find(fence, at)) {
    at += fence.size();
    ReadOptions options;
    options.model_folders = {root / "netlists"};
    std::string example = text.substr(at, text.find("```", at) - at);
    if (example.find("[simulate]") == example.npos) example += "[simulate]\nstop = 1\n";
    INFO(example);
    CHECK_EQ(messages(read_scene_text(example, "scene.toml", root / "core" / "netlist", declarations(), options)), "");
    ++examples;
  }
  CHECK(examples >= 6);
}

}  // namespace rheonet::test::readme_test
