#include "core/netlist/lookup_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rheonet {

LookupTable::LookupTable(std::vector<double> arguments, std::vector<double> values, bool smooth, std::size_t variables)
    : lines_({arguments.front(), values.front(), 0}, largest_of(values)), variables_(variables), points_(arguments.size()) {
  const double last = arguments.back(), end = values.back();
  if (smooth && points_ > 1) {
    lines_.begin(arguments.front(), {arguments.front(), values.front(), 0});
    lines_.begin(last, {last, end, 0});
    curve_.emplace(std::move(arguments), std::move(values));
    return;
  }
  for (std::size_t k = 0; k + 1 < points_; ++k) {
    const double length = arguments[k + 1] - arguments[k];
    if (length > 0) lines_.append(arguments[k], {arguments[k], values[k], (values[k + 1] - values[k]) / length});
  }
  lines_.append(last, {last, end, 0});
}

std::string LookupTable::text() const { return fmt::format("table, {} point{}", points_, points_ == 1 ? "" : "s"); }

/// Number of the piece that holds.
std::size_t LookupTable::number_at(double u, std::span<const double> sides) const {
  return sides.empty() || std::isnan(sides[0]) ? lines_.line_at(u) : static_cast<std::size_t>(sides[0]);
}

std::optional<double> LookupTable::value(std::span<const double> arguments, std::span<const double> sides) const {
  const std::size_t number = number_at(arguments[0], sides);
  const double y = curved(number) ? curve_->value(arguments[0]) : lines_.lines()[number].at(arguments[0]);
  return std::isfinite(y) ? std::optional(y) : std::nullopt;
}

std::optional<double> LookupTable::value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const {
  const std::size_t number = number_at(arguments[0], sides);
  std::fill(partials.begin(), partials.end(), 0.0);
  partials[0] = curved(number) ? curve_->rate(arguments[0]) : lines_.lines()[number].slope;
  return std::isfinite(partials[0]) ? value(arguments, sides) : std::nullopt;
}

bool LookupTable::complete_sides(std::span<const double> arguments, std::span<double> sides) const {
  if (!sides.empty()) sides[0] = static_cast<double>(number_at(arguments[0], sides));
  return !std::isnan(arguments[0]);
}

bool LookupTable::cross(std::size_t, std::span<const double> arguments, std::span<double> sides) const {
  const auto number = static_cast<std::size_t>(sides[0]);
  const double u = arguments[0];
  const std::vector<double>& ends = lines_.ends();
  const bool at_first = number == 0, at_last = number == ends.size();
  const bool up = at_first || (!at_last && ends[number] - u < u - ends[number - 1]);
  sides[0] += up ? 1 : -1;
  return !std::isnan(u);
}

bool LookupTable::switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const {
  const std::vector<double>& ends = lines_.ends();
  if (ends.empty()) return true;
  const double u = arguments[0];
  const std::size_t number = number_at(u, sides);
  values[0] = std::numeric_limits<double>::infinity();
  if (number > 0) values[0] = u - ends[number - 1];
  if (number < ends.size()) values[0] = std::min(values[0], ends[number] - u);
  return !std::isnan(u);
}

}  // namespace rheonet
