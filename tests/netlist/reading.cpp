#include "tests/netlist/reading.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

#include "tests/netlist/fake_declarations.hpp"

namespace rheonet::test {

namespace fs = std::filesystem;

Folder::Folder() {
  static int number = 0;
  path_ = fs::temp_directory_path() / ("rheonet-test-" + std::to_string(getpid()) + "-" + std::to_string(number++));
  fs::create_directories(path_);
}

Folder::~Folder() { fs::remove_all(path_); }

fs::path Folder::write(const std::string& name, const std::string& text) const {
  const fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  return file;
}

ReadResult read(const std::string& netlist, const ReadOptions& options, const fs::path& folder) {
  std::string text = netlist.starts_with('\n') ? netlist.substr(1) : netlist;
  if (text.find("[simulate]") == text.npos) text += "[simulate]\nstop = 1\n";
  return read_scene_text(text, "scene.toml", folder, fake_declarations(), options);
}

std::string messages(const ReadResult& result) {
  std::string text;
  for (const Diagnostic& diagnostic : result.diagnostics) text += format(diagnostic, result.sources) + '\n';
  return text;
}

Scene scene_of(const std::string& netlist, const ReadOptions& options, const fs::path& folder) {
  const ReadResult result = read(netlist, options, folder);
  INFO(netlist);
  REQUIRE_MESSAGE(result.scene, messages(result));
  CHECK(messages(result) == "");
  return *result.scene;
}

void check_all(const std::vector<BadNetlist>& netlists) {
  for (const auto& [what, netlist, expected, overrides] : netlists) {
    INFO(what);
    const ReadResult result = read(netlist, {.overrides = overrides, .accuracy = {}, .library = {}});
    CHECK('\n' + messages(result) == expected);
    CHECK_FALSE(result.scene);
  }
}

}  // namespace rheonet::test
