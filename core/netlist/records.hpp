#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"
#include "core/netlist/scene.hpp"
#include "core/netlist/scene_index.hpp"

namespace rheonet {

/// The quantity measured by a channel of a node, element or assembly. (Outputs of blocks have their own units: `unit_of`.)
Quantity quantity_of(Record::Channel channel);

/// The number 1 in a unit (plain if the unit is open), and the unit of a number.
Number one_of(const BlockUnit& unit);
BlockUnit unit_of(const Number& number);

/// The records of a scene that names none, in the order of its file: motion and force of everything.
std::vector<Record> every_record(const Scene& scene);

/// Finds the records named by `simulate.record` (`k1.force`); takes all records if it is not given. Names that begin with
/// one in `doubtful` (it has a mistake) are not reported as unknown. Expressions with a mistake are added to `doubtful`.
void resolve_records(const TomlEntry* record, const Environment& environment, std::set<std::string>& doubtful, Context& context,
                     Scene& scene);

/// Adds the records of the command line after those of the file.
void add_records(const std::vector<std::string>& paths, const std::set<std::string>& doubtful, Context& context,
                 Sources& sources, Scene& scene);

/// Whether a record may be the input of a block.
bool may_be_sensed(const Record& record);

/// The records at these paths, each a string with its place; absent for a path that is a mistake. Sums over assemblies are
/// added to the expressions of the scene. `sensed`: inputs of blocks, for the channels that a hint offers. `known`: an index of
/// the scene that has the owner of each path (`k1` of `k1.force`); without it an index is built.
std::vector<std::optional<Record>> find_records(const std::vector<TomlValue>& paths,
                                                const std::set<std::string>& doubtful, Context& context,
                                                Scene& scene, bool sensed = false, const SceneIndex* known = nullptr);

/// Reads initial values from `[nodes]`.
void read_initial_values(const TomlValue& nodes, const Environment& environment, const std::set<std::string>& doubtful,
                         Context& context, Scene& scene);

}  // namespace rheonet
