#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

/// The points of a signal from a CSV file.
struct TableFile {
  std::vector<std::pair<double, double>> points;  ///< time [s], value
  Number unit;                                    ///< 1 in the unit of the values; plain if the file gives none
};

/// Reads the points (time, value) of a signal from a CSV file: two columns of numbers, optionally quoted, separated by
/// commas, semicolons, tabs or spaces. The first row may be a header, whose fields may end with a unit in brackets ("t
/// [ms]"). Empty lines and lines that begin with `#` are skipped. The string `name` names the file; `columns`, if not
/// empty, names two of its columns as in the header, without units. The first ten mistakes are reported with their lines,
/// further ones by their number.
std::optional<TableFile> read_table_file(const TomlValue& name, const std::vector<TomlValue>& columns, Context& context);

}  // namespace rheonet
