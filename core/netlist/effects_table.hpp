#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// The effects that an element type with these values brings: those whose parameter is finite and above 0.
std::vector<Effect> declared_effects(const Declaration& declaration, std::span<const double> values);

/// Reads `[effects]` (nullptr: there is none) and what the command line says of effects: `without` adds to the table, `only` takes
/// its place. A word that names no effect, or nothing in the scene, is a mistake. Leaving out an
/// effect that nothing brings is a warning.
void read_effects(const TomlEntry* table, const std::vector<std::string>& without, const std::optional<std::vector<std::string>>& only,
                  Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
