#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/work_precision.hpp"
#include "tools/plot/compose.hpp"

namespace rheonet::tool {

/// A price list as text: a table for each method, and a recommendation.
std::string describe(const Scene& scene, const std::string& file, const PriceList& list);

/// The same as CSV, a row for each method, with the relative error of every record.
std::string table(const Scene& scene, const PriceList& list);

/// CPU time and steps over the error: a curve for each method.
std::vector<plot::Measured> curves(const PriceList& list);

}  // namespace rheonet::tool
