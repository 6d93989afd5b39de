#pragma once

#include <set>
#include <string>

#include "core/netlist/context.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[plot]`: curves and their units. `scene` already has its elements and nodes.
PlotTable read_plot_table(const TomlValue& plot, const std::set<std::string>& doubtful, Context& context,
                          Scene& scene);

/// Reads `[demo]`: texts, and ranges of the scene's parameters.
Demo read_demo(const TomlValue& demo, const Environment& environment, Context& context);

}  // namespace rheonet
