#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// The effects of an element of this type with these values: those whose parameter is finite and above 0.
std::vector<Effect> declared_effects(const Declaration& declaration, std::span<const double> values);

/// Reads `[effects]` (nullptr: absent) and the effects on the command line: `without` adds to the table, `only` replaces
/// it. A word that names no effect, or no part of the scene, is a mistake. Leaving out an effect that no element brings is
/// a warning.
void read_effects(const TomlEntry* table, const std::vector<std::string>& without, const std::optional<std::vector<std::string>>& only,
                  Context& context, Sources& sources, Scene& scene);

}  // namespace rheonet
