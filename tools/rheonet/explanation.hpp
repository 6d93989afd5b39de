#pragma once

#include <string>
#include <vector>

#include "core/result/explain.hpp"

namespace rheonet::tool {

/// A part of an explanation as text; names are between backticks.
struct Passage {
  std::string heading = {};
  struct Line {
    std::string label = {};  ///< Often "".
    std::string text = {};
  };
  std::vector<Line> lines = {};
};
std::vector<Passage> passages(const Scene& scene, const Explanation& explanation);

/// An explanation as text. `file` is the name of the scene.
std::string describe(const Scene& scene, const std::string& file, const Explanation& explanation);

/// The same as JSON, with every name.
std::string to_json(const Scene& scene, const Explanation& explanation);

}  // namespace rheonet::tool
