#pragma once

#include <string>
#include <vector>

namespace rheonet::tool {

/// Rows of cells as aligned lines, two blanks between columns: the first column to the left, the others to the right.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

/// "0.00123 N": a value for a person to read; a blank unit or "1" is left out.
std::string readable(double value, const std::string& unit, int digits = 6);

}  // namespace rheonet::tool
