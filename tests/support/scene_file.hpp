#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "tests/support/simulate.hpp"

namespace rheonet::test {

/// A netlist of the project that has been run: its rows and its values [SI]. Tests take the values from here, so that they stay valid if the
/// netlist changes.
struct SceneFile {
  Scene scene;
  RunTable rows;
  Summary summary;

  /// A parameter of an element as the scene has it; fails the test if there is none.
  double value(const std::string& element, const std::string& parameter) const;
};

/// A netlist of the project. `path` counts from the folder netlists; each override is "PATH=VALUE", as after --set. Fails
/// the test if the scene is refused.
Scene scene_of_file(const std::string& path, const std::vector<std::string>& overrides = {});
SceneFile run_file(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace rheonet::test
