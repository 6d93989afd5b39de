#pragma once

#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Warns of nodes named by the scene itself at which only one element ends: the element carries no force, and the name is
/// often mistyped. Also warns of nodes that differ from `ground` only in case.
std::vector<Diagnostic> loose_nodes(const Scene& scene);

}  // namespace rheonet
