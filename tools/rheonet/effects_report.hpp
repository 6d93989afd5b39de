#pragma once

#include <string>

#include "core/result/model_hierarchy.hpp"

namespace rheonet::tool {

/// The model hierarchy of a scene as text, and a recommendation: the effects that can be left out if records may be wrong by `within` of
/// their largest magnitude.
std::string describe(const Scene& scene, const std::string& file, const ModelHierarchy& ladder, double within);

/// The same as CSV: a row for each model and record.
std::string table(const Scene& scene, const ModelHierarchy& ladder);

}  // namespace rheonet::tool
