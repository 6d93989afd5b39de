#include "tools/rheonet/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/netlist/characters.hpp"

namespace rheonet::tool {

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], count_characters(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - count_characters(row[i]), ' ');
      line += "  " + (i == 0 ? row[i] + blanks : blanks + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

std::string readable(double value, const std::string& unit, int digits) {
  return fmt::format("{:.{}g}{}{}", value + 0.0, digits, unit.empty() || unit == "1" ? "" : " ", unit == "1" ? "" : unit);
}

}  // namespace rheonet::tool
