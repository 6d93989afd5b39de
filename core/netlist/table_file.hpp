#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

/// The points of a signal as a CSV file gives them.
struct TableFile {
  std::vector<std::pair<double, double>> points;  ///< time [s], value
  Number unit;                                    ///< of the values: 1 of it; plain if the file says none
};

/// Reads the points (time, value) of a signal from a CSV file: two columns of numbers, in quotes or not, split by commas,
/// semicolons, tabs or spaces; the first row may be a header, whose fields may end with a unit in brackets ("t [ms]");
/// empty lines and lines that begin with `#` are left out. `name` is the string that names the file; `columns`, if any, are the names
/// of two of its columns, as its first row has them without their units. The first ten
/// mistakes are reported with their lines in the CSV file, of others how many there are.
std::optional<TableFile> read_table_file(const TomlValue& name, const std::vector<TomlValue>& columns, Context& context);

}  // namespace rheonet
