#include "tests/support/scene_file.hpp"

#include <doctest/doctest.h>

#include <filesystem>

#include "core/netlist/read.hpp"
#include "core/network/component.hpp"

namespace rheonet::test {

double SceneFile::value(const std::string& element, const std::string& parameter) const {
  for (const SceneElement& e : scene.elements) {
    if (e.name != element) continue;
    const Declaration& d = components()[static_cast<std::size_t>(e.declaration)]->declaration;
    for (std::size_t k = 0; k < d.parameters.size(); ++k) {
      if (d.parameters[k].name_in(scene.domain) == parameter) return e.values[k];
    }
  }
  FAIL("no " << parameter << " of " << element);
  return 0;
}

Scene scene_of_file(const std::string& path, const std::vector<std::string>& overrides) {
  const std::filesystem::path folder = std::filesystem::path(RHEONET_SOURCE_DIR) / "netlists";
  ReadOptions options;
  options.overrides = overrides;
  options.model_folders = {folder};
  const ReadResult read = read_scene(folder / path, declarations(), options);
  for (const Diagnostic& diagnostic : read.diagnostics) FAIL_CHECK(format(diagnostic, read.sources));
  REQUIRE(read.scene);
  return *read.scene;
}

SceneFile run_file(const std::string& path, const std::vector<std::string>& overrides) {
  SceneFile file{scene_of_file(path, overrides), {}, {}};
  file.rows = simulate(file.scene, &file.summary);
  return file;
}

}  // namespace rheonet::test
