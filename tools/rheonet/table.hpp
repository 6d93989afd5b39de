#pragma once

#include <string>
#include <vector>

namespace rheonet::tool {

/// Rows of cells as aligned lines, with two blanks between columns. The first column is left-aligned, the others right-aligned.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

/// A value with its unit: "0.00123 N". An empty unit or "1" is left out.
std::string readable(double value, const std::string& unit, int digits = 6);

}  // namespace rheonet::tool
