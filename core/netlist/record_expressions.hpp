#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// The entries `{ name = "gap", value = "a.position - b.position" }` of `simulate.record`: expressions over records, parameters
/// and each other. Returns the record of each, in their order; absent, with a mistake, where the entry has one. The
/// expressions are added to the scene, the names of those with a mistake to `doubtful`. `entries` must be tables.
std::vector<std::optional<Record>> read_record_expressions(const std::vector<const TomlValue*>& entries, const Environment& environment,
                                                           std::set<std::string>& doubtful, Context& context, Scene& scene);

/// The record of an expression of the scene that has this name.
std::optional<Record> find_expression(const Scene& scene, const std::string& name);

/// A power or an energy of an assembly: the sum over its elements. `path` is that of the record. Absent, with a mistake at
/// `spot`, for the power of an assembly that contains a motion or a force.
std::optional<Record> sum_over_assembly(const std::string& path, const SceneAssembly& assembly, Record::Channel channel, Spot spot,
                                        Context& context, Scene& scene);

}  // namespace rheonet
