#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/netlist/context.hpp"

namespace rheonet {

/// Reads the points (time, value) of a signal from a CSV file: two columns of numbers in SI, split by commas,
/// semicolons, tabs or spaces; the first row may be a header; empty lines and lines that begin with `#` are left out.
/// `name` is the string that names the file. Mistakes are reported with the line of the CSV file.
std::optional<std::vector<std::pair<double, double>>> read_table_file(const TomlValue& name, Context& context);

}  // namespace rheonet
