#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/context.hpp"
#include "core/netlist/expression.hpp"

namespace rheonet {

/// Points from a CSV file.
struct TableFile {
  std::vector<std::pair<double, double>> points;  ///< abscissa, for a signal the time [s]; value
  Number argument;                                ///< 1 in the unit of the abscissa; plain if the file gives none
  Number unit;                                    ///< 1 in the unit of the values; plain if the file gives none
};

/// Quantity of the first column of a table.
struct TableAbscissa {
  std::optional<Quantity> quantity = Quantity::time;  ///< absent: any
  std::string name = "time";
  std::string of = "a signal";  ///< what the table is of
};

/// Reads points from a CSV file: two columns of numbers, optionally quoted, separated by commas, semicolons, tabs or spaces; the
/// first one does not decrease. The first row may be a header, whose fields may end with a unit in brackets ("t [ms]"). Empty
/// lines and lines that begin with `#` are skipped. The string `name` names the file; `columns`, if not empty, names two of its
/// columns as in the header, without units. The first ten mistakes are reported with their lines, further ones by their number.
std::optional<TableFile> read_table_file(const TomlValue& name, const std::vector<TomlValue>& columns, const TableAbscissa& abscissa,
                                         Context& context);

/// Reads an entry `columns` that names two columns of a CSV file, the first one of an `abscissa` ("time"): `example` has two such
/// names. A mistake unless the points come `from_file`; then the result is empty.
std::vector<TomlValue> read_column_names(const TomlEntry& columns, bool from_file, const std::string& abscissa, const std::string& example,
                                         DiagnosticList& diagnostics);

}  // namespace rheonet
