#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Finds nodes, elements and assemblies of a scene by their paths. A scene of millions is gone through once for all
/// names that are looked for, instead of being indexed.
class SceneIndex {
 public:
  struct Found {
    int node = -1;
    int element = -1;
    int assembly = -1;
    int block = -1;  ///< that the element is

    bool any() const { return node >= 0 || element >= 0 || assembly >= 0; }
  };

  SceneIndex(const Scene& scene, const std::vector<std::string>& wanted);

  /// One of the wanted names.
  Found find(const std::string& name) const { return found_.at(name); }

 private:
  std::unordered_map<std::string, Found> found_;
};

/// Paths of a scene, to choose a nearest one from: of all nodes, and of everything else too if `all`. The first ones of
/// a scene of very many.
std::vector<std::string> known_paths(const Scene& scene, bool all);

}  // namespace rheonet
