#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// What a channel of a node, element or assembly measures. (Outputs of blocks have units of their own: `unit_of`.)
Quantity quantity_of(Record::Channel channel);

/// One of a unit, plain if it is open; and the unit of a number.
Number one_of(const BlockUnit& unit);
BlockUnit unit_of(const Number& number);

/// All there is to record of a scene, in the order of its file.
std::vector<Record> every_record(const Scene& scene);

/// Finds the quantities that `simulate.record` names (`k1.force`), or all there are if it is not given. What begins
/// with a name in `doubtful` (something is wrong with it) is not reported as unknown.
void resolve_records(const TomlEntry* record, const std::set<std::string>& doubtful, Context& context, Scene& scene);

/// Records that the command line asks for, after those of the file.
void add_records(const std::vector<std::string>& paths, const std::set<std::string>& doubtful, Context& context,
                 Sources& sources, Scene& scene);

/// The records of these paths, each a string with its place; absent where that is a mistake.
std::vector<std::optional<Record>> find_records(const std::vector<TomlValue>& paths,
                                                const std::set<std::string>& doubtful, Context& context,
                                                const Scene& scene);

/// Initial values from `[nodes]`.
void read_initial_values(const TomlValue& nodes, const Environment& environment, const std::set<std::string>& doubtful,
                         Context& context, Scene& scene);

}  // namespace rheonet
