#pragma once

#include <string>

#include "core/result/explain.hpp"

namespace rheonet::tool {

/// An explanation for a person to read. `file` is what the scene is called.
std::string describe(const Scene& scene, const std::string& file, const Explanation& explanation);

/// The same as JSON, with every name.
std::string to_json(const Scene& scene, const Explanation& explanation);

}  // namespace rheonet::tool
