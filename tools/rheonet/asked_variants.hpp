#pragma once

#include <optional>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/simulation_method.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// The methods that `--variant` of `precision` asks for: other scenes, or this scene with other values. Each has the records of `scene` in
/// the same order; `--pair` gives the names of these records in another scene. All methods and `scene` get one time base. Returns nothing,
/// after printing messages, if a variant cannot be read or lacks a record.
std::optional<std::vector<SimulationMethod>> asked_variants(const Arguments& arguments, Scene& scene);

}  // namespace rheonet::tool
