#include "core/netlist/table_points.hpp"

#include <fmt/format.h>

namespace rheonet {

TablePoints read_table_points(const TomlValue& array, const std::string& x, const std::string& y, DiagnosticList& diagnostics) {
  TablePoints result;
  result.points.reserve(array.items.size());
  for (const TomlValue& item : array.items) {
    if (!item.is_array() || item.items.size() != 2) {
      diagnostics.error(item.spot, fmt::format("a point of a table is an array of two values, [{}, {}], but this {}", x, y,
                                               item.is_array() ? fmt::format("has {}", item.items.size()) : "is " + describe(item)));
      return result;
    }
    result.points.push_back({Formula(item.items[0], fmt::format("the {} of a point", x), diagnostics),
                             Formula(item.items[1], fmt::format("the {} of a point", y), diagnostics)});
    const auto& [first, second] = result.points.back();
    result.constant = result.constant && first.identifiers().empty() && second.identifiers().empty();
  }
  return result;
}

}  // namespace rheonet
