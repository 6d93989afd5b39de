#pragma once

#include <optional>
#include <vector>

#include "core/netlist/scene.hpp"
#include "core/result/simulation_method.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// The manners that `--variant` of `precision` asks for: other scenes, or other values of this one, all with the records of the
/// scene, in its order, other scenes' under the names that `--pair` gives them. All get one time base, the scene too. Nothing, with messages,
/// if one of them cannot be read or has not what the scene records.
std::optional<std::vector<SimulationMethod>> asked_variants(const Arguments& arguments, Scene& scene);

}  // namespace rheonet::tool
