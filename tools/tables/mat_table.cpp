#include "tools/tables/mat_table.hpp"

#include <algorithm>
#include <charconv>
#include <map>

namespace rheonet::tables {

std::string as_csv(MatTable table) {
  std::map<std::size_t, std::size_t> frequency;  // of each length
  for (const MatTable::Column& column : table.columns) ++frequency[column.numbers.size()];
  const auto most = std::max_element(frequency.begin(), frequency.end(), [](const auto& a, const auto& b) { return a.second <= b.second; });
  const std::size_t rows = most == frequency.end() ? 0 : most->first;
  auto& columns = table.columns;
  std::erase_if(columns, [rows](const MatTable::Column& column) { return column.numbers.size() != rows; });
  if (columns.empty() || rows == 0) throw MatError("it has no vector of numbers");
  if (table.names.size() == columns.size() && table.units.size() == columns.size()) {
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].name = table.names[k] + (table.units[k].empty() ? "" : " [" + table.units[k] + "]");
  } else if (table.of_rheonet) {
    throw MatError("it is damaged or cut: rheonet wrote it, but its cell arrays `columns` and `units` do not name its vectors");
  }
  std::string text;
  for (std::size_t k = 0; k < columns.size(); ++k) text += (k > 0 ? ",\"" : "\"") + columns[k].name + '"';
  text += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    char number[32];  // 17 digits, sign, point and exponent
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto written = std::to_chars(number, number + sizeof number, columns[k].numbers[row]);
      if (k > 0) text += ',';
      text.append(number, written.ptr);
    }
    text += '\n';
  }
  return text;
}

bool table_text(MatTable (*read)(const char* path), const char* path, std::string& text, std::string& why) {
  try {
    text = as_csv(read(path));
    return true;
  } catch (const MatError& error) {
    why = error.what();
    return false;
  }
}

}  // namespace rheonet::tables
