#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "tests/netlist/reading.hpp"

namespace rheonet::test {

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
    scene_of(text.substr(at, text.find("```", at) - at), options, root / "core" / "netlist");
    ++examples;
  }
  CHECK(examples >= 6);
}

}  // namespace rheonet::test
