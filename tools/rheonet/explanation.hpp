#pragma once

#include <string>
#include <vector>

#include "core/result/explain.hpp"

namespace rheonet::tool {

/// A part of an explanation in words; names are between backticks.
struct Passage {
  std::string heading = {};
  struct Line {
    std::string label = {};  ///< "" of most
    std::string text = {};
  };
  std::vector<Line> lines = {};
};
std::vector<Passage> passages(const Scene& scene, const Explanation& explanation);

/// An explanation for a person to read. `file` is what the scene is called.
std::string describe(const Scene& scene, const std::string& file, const Explanation& explanation);

/// The same as JSON, with every name.
std::string to_json(const Scene& scene, const Explanation& explanation);

}  // namespace rheonet::tool
