#include "core/netlist/lookup_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/numerics.hpp"

namespace rheonet {

LookupTable::LookupTable(std::vector<double> arguments, std::vector<double> values, bool smooth, std::size_t variables)
    : variables_(variables), points_(arguments.size()) {
  pieces_.push_back({arguments.front(), values.front(), 0});
  const auto add = [&](double at, const Piece& piece) {
    ends_.push_back(at);
    pieces_.push_back(piece);
  };
  if (smooth && points_ > 1) {
    const double first = arguments.front(), last = arguments.back(), end = values.back();
    curve_.emplace(std::move(arguments), std::move(values));
    add(first, {first, 0, 0, true});
    add(last, {last, end, 0});
    return;
  }
  double largest = 0;
  for (const double y : values) largest = std::max(largest, std::abs(y));
  for (std::size_t k = 0; k + 1 < points_; ++k) {
    const double length = arguments[k + 1] - arguments[k];
    if (length == 0) continue;
    const double slope = (values[k + 1] - values[k]) / length;
    const Piece& before = pieces_.back();
    // Points on one line need no event between them.
    const double reached = before.value + before.slope * (arguments[k] - before.origin);
    const bool bends = std::abs(slope - before.slope) > numerics::equal_given_values * (std::abs(slope) + std::abs(before.slope));
    const bool jumps = std::abs(reached - values[k]) > numerics::equal_given_values * largest;
    if (bends || jumps) add(arguments[k], {arguments[k], values[k], slope});
  }
  const Piece& before = pieces_.back();
  const double reached = before.value + before.slope * (arguments.back() - before.origin);
  if (before.slope != 0 || reached != values.back()) add(arguments.back(), {arguments.back(), values.back(), 0});
}

std::string LookupTable::text() const { return fmt::format("table, {} point{}", points_, points_ == 1 ? "" : "s"); }

/// Number of the piece at u.
double LookupTable::number_at(double u) const {
  return static_cast<double>(std::upper_bound(ends_.begin(), ends_.end(), u) - ends_.begin());
}

const LookupTable::Piece& LookupTable::piece(double u, std::span<const double> sides) const {
  const double number = sides.empty() || std::isnan(sides[0]) ? number_at(u) : sides[0];
  return pieces_[static_cast<std::size_t>(number)];
}

std::optional<double> LookupTable::value(std::span<const double> arguments, std::span<const double> sides) const {
  const double u = arguments[0];
  const Piece& p = piece(u, sides);
  const double y = p.curved ? curve_->value(u) : p.value + p.slope * (u - p.origin);
  return std::isfinite(y) ? std::optional(y) : std::nullopt;
}

std::optional<double> LookupTable::value(std::span<const double> arguments, std::span<const double> sides, std::span<double> partials) const {
  const Piece& p = piece(arguments[0], sides);
  std::fill(partials.begin(), partials.end(), 0.0);
  partials[0] = p.curved ? curve_->rate(arguments[0]) : p.slope;
  return std::isfinite(partials[0]) ? value(arguments, sides) : std::nullopt;
}

bool LookupTable::complete_sides(std::span<const double> arguments, std::span<double> sides) const {
  if (!sides.empty() && std::isnan(sides[0])) sides[0] = number_at(arguments[0]);
  return !std::isnan(arguments[0]);
}

bool LookupTable::cross(std::size_t, std::span<const double> arguments, std::span<double> sides) const {
  const auto number = static_cast<std::size_t>(sides[0]);
  const double u = arguments[0];
  const bool at_first = number == 0, at_last = number == ends_.size();
  const bool up = at_first || (!at_last && ends_[number] - u < u - ends_[number - 1]);
  sides[0] += up ? 1 : -1;
  return !std::isnan(u);
}

bool LookupTable::switching_functions(std::span<const double> arguments, std::span<const double> sides, std::span<double> values) const {
  if (ends_.empty()) return true;
  const double u = arguments[0];
  const auto number = static_cast<std::size_t>(sides.empty() || std::isnan(sides[0]) ? number_at(u) : sides[0]);
  values[0] = std::numeric_limits<double>::infinity();
  if (number > 0) values[0] = u - ends_[number - 1];
  if (number < ends_.size()) values[0] = std::min(values[0], ends_[number] - u);
  return !std::isnan(u);
}

}  // namespace rheonet
