#pragma once

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/read.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[simulate]` but for `record`, the entry of which it returns (nullptr if not given).
const TomlEntry* read_simulate(const TomlEntry& simulate, const Environment& environment, Context& context,
                               Scene& scene);

/// Sets the accuracy of the command line.
void override_accuracy(double accuracy, Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
