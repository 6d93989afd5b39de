#pragma once

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "core/netlist/csv_fields.hpp"

namespace rheonet::test {

using Row = std::vector<std::string>;

/// The rows of a CSV text, the header first.
inline std::vector<Row> table(const std::string& text) {
  std::vector<Row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    for (const CsvField& field : csv_fields(line)) rows.back().emplace_back(field.text);
  }
  return rows;
}

inline double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

}  // namespace rheonet::test
