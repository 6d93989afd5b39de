#pragma once

#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Reads `[effects]` (nullptr: there is none) and what the command line says of effects: `without` adds to the table, `only` takes
/// its place. What names no effect, or nothing in the scene, is a mistake.
void read_effects(const TomlEntry* table, const std::vector<std::string>& without, const std::optional<std::vector<std::string>>& only,
                  Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
