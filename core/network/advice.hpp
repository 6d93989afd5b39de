#pragma once

#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Warnings about likely mistakes in a scene that can be simulated, in the order of the file. They are about loose nodes
/// (loose_nodes.hpp); nodes whose names differ in capital letters only; parts that touch the rest at ground only; a scene or
/// a part that nothing drives; tables that end before the run does. Linear in the size of the scene.
std::vector<Diagnostic> advice_on(const Scene& scene);

}  // namespace rheonet
