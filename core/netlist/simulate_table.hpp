#pragma once

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/read.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[simulate]` except `record`, whose entry is returned (nullptr if absent).
const TomlEntry* read_simulate(const TomlEntry& simulate, const Environment& environment, Context& context,
                               Scene& scene);

/// Applies the accuracy given on the command line.
void override_accuracy(double accuracy, Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
