#pragma once

#include <vector>

#include "core/netlist/diagnostic.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Warnings of nodes that the scene itself names and at which a single element ends: it carries no force, and mostly the
/// name is mistyped. Also of nodes that would be `ground` but for capital letters.
std::vector<Diagnostic> loose_nodes(const Scene& scene);

}  // namespace rheonet
