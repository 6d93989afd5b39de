#pragma once

#include <set>
#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[expect]`: for each record one claim or several on its course through the run, which must lie in [simulate].
/// What begins with a name in `doubtful` is not reported as unknown.
void read_claims(const TomlValue& expect, const Environment& environment, const std::set<std::string>& doubtful,
                 Context& context, Scene& scene);

}  // namespace rheonet
