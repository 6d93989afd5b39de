#pragma once

#include <string>
#include <vector>

#include "core/netlist/diagnostic_list.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

/// Points of a table as given by the file, to be evaluated in an environment.
struct TablePoints {
  struct Point { Formula x, y; };
  std::vector<Point> points = {};
  bool constant = true;  ///< they contain no names
};

/// Reads an array of points, pairs of two values. `x` and `y` name these in messages: "time", "value". At the first mistake the
/// result ends.
TablePoints read_table_points(const TomlValue& array, const std::string& x, const std::string& y, DiagnosticList& diagnostics);

}  // namespace rheonet
