#pragma once

#include <set>
#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[expect]`: one or more claims on the course of each record; their times must lie within the run. Names that begin
/// with one in `doubtful` are not reported as unknown.
void read_claims(const TomlValue& expect, const Environment& environment, const std::set<std::string>& doubtful,
                 Context& context, Scene& scene);

}  // namespace rheonet
