#pragma once

#include <set>
#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Finds the quantities that `simulate.record` names (`k1.force`), or all there are if it is not given. What begins
/// with a name in `doubtful` (something is wrong with it) is not reported as unknown.
void resolve_records(const TomlEntry* record, const std::set<std::string>& doubtful, Context& context, Scene& scene);

/// Initial values from `[nodes]`.
void read_initial_values(const TomlValue& nodes, const Environment& environment, const std::set<std::string>& doubtful,
                         Context& context, Scene& scene);

}  // namespace rheonet
