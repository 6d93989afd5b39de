#include "tests/netlist/reading.hpp"

#include <doctest/doctest.h>

#include "tests/netlist/fake_declarations.hpp"

namespace rheonet::test {

namespace fs = std::filesystem;

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

Scene sound_scene(const std::string& netlist, const ReadOptions& options, const fs::path& folder) {
  const ReadResult result = read(netlist, options, folder);
  INFO(netlist);
  REQUIRE_MESSAGE(result.scene, messages(result));
  CHECK(messages(result) == "");
  return *result.scene;
}

void check_all(const std::vector<BadNetlist>& netlists) {
  for (const BadNetlist& bad : netlists) {
    INFO(bad.what);
    const ReadResult result = read(bad.netlist, {.overrides = bad.overrides, .accuracy = {}, .model_folders = {}});
    CHECK('\n' + messages(result) == bad.messages);
    CHECK_FALSE(result.scene);
  }
}

}  // namespace rheonet::test
