#pragma once

#include <set>
#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[exact]`: closed forms of records, as expressions of the parameters and the time `t`. Needs the records resolved.
void read_analytic_solutions(const TomlValue& exact, const Environment& environment, const std::set<std::string>& doubtful,
                Context& context, Scene& scene);

}  // namespace rheonet
