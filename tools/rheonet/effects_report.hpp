#pragma once

#include <string>

#include "core/result/model_hierarchy.hpp"

namespace rheonet::tool {

/// The ladder of a scene for a person to read, with a recommendation: what it can do without where records may be off by
/// `within` of their largest magnitude.
std::string describe(const Scene& scene, const std::string& file, const ModelHierarchy& ladder, double within);

/// The same as CSV: a row for each model and record.
std::string table(const Scene& scene, const ModelHierarchy& ladder);

}  // namespace rheonet::tool
