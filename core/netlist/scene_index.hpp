#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Finds nodes, elements and assemblies of a scene by their paths. One pass over the scene finds all wanted names; an index
/// of a scene with millions of elements would cost more.
class SceneIndex {
 public:
  struct Found {
    int node = -1;
    int element = -1;
    int assembly = -1;
    int block = -1;  ///< the block of this element

    bool any() const { return node >= 0 || element >= 0 || assembly >= 0; }
  };

  SceneIndex(const Scene& scene, const std::vector<std::string>& wanted);

  /// `name` must be one of the wanted names.
  Found find(const std::string& name) const { return found_.at(name); }

 private:
  std::unordered_map<std::string, Found> found_;
};

/// Paths of a scene among which the nearest name is searched for: of all nodes, and of everything else if `all`. Limited to the first paths of a very large scene.
std::vector<std::string> known_paths(const Scene& scene, bool all);

}  // namespace rheonet
