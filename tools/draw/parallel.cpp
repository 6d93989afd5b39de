#include <algorithm>
#include <cmath>

#include "tools/draw/draftsman.hpp"

namespace rheonet::draw {
namespace {

/// Beside bars that go on: dots below each other.
Piece omission(const Block& block) {
  Piece piece;
  piece.up = piece.down = 14;
  piece.width = 120;
  piece.entries.clear();
  piece.exits.clear();
  for (const double y : {-8.0, 0.0, 8.0}) piece.ink.joints.push_back({piece.width / 2 - 36, y});
  piece.ink.labels.push_back(omission_label(block.times, {piece.width / 2 + 6, 4}));
  return piece;
}

/// Parts below each other.
Piece column(const std::vector<Piece>& parts, NodeId left, NodeId right, double gap) {
  Piece all;
  std::vector<double> heights{0};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all.width = std::max(all.width, parts[i].width);
    if (i > 0) heights.push_back(heights.back() + parts[i - 1].down + gap + parts[i].up);
  }
  // Between the two middle ones, or on the middle one.
  const double axis = (heights[(parts.size() - 1) / 2] + heights[parts.size() / 2]) / 2;
  all.exit = (parts.front().exit + heights.back() + parts.back().exit) / 2 - axis;
  all.entries.clear();
  all.exits.clear();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Piece& part = parts[i];
    const double y = heights[i] - axis, before = (all.width - part.width) / 2, after = before + part.width;
    all.add(part, {before, y});
    // A part that is joined at several heights has a wire at each of them, unless the way is long.
    constexpr double short_way = 30;
    if (before < short_way) {
      for (const double entry : part.entries) all.wire(left, {{0, y + entry}, {before, y + entry}});
      for (const double exit : part.exits) all.wire(right, {{after, y + exit}, {all.width, y + exit}});
      for (const double entry : part.entries) all.entries.push_back(y + entry);
      for (const double exit : part.exits) all.exits.push_back(y + exit);
      continue;
    }
    if (part.entries.empty()) continue;
    const auto joined = [&](NodeId node, double from, double to, double axis_of, std::vector<double> ends) {
      all.wire(node, {{from, axis_of}, {to, axis_of}});
      std::sort(ends.begin(), ends.end());
      if (ends.size() > 1) all.wire(node, {{to, y + ends.front()}, {to, y + ends.back()}});
    };
    joined(left, 0, before, y, part.entries);
    joined(right, all.width, after, y + part.exit, part.exits);
    all.entries.push_back(y);
    all.exits.push_back(y + part.exit);
  }
  return all;
}

/// Columns beside each other. A rail above leads into them, and one below leads out.
Piece columns_of(const std::vector<Piece>& columns, NodeId left, NodeId right) {
  constexpr double rail = 10, apart = 20;
  Piece all;
  double up = 0, down = 0;
  for (const Piece& column : columns) up = std::max(up, column.up);
  for (const Piece& column : columns) down = std::max(down, column.down - column.up + up);
  const double middle = (down - up) / 2, top = -up - middle - rail, bottom = down - middle + rail;
  std::vector<double> begins;
  for (const Piece& column : columns) {
    begins.push_back(all.width);
    all.width += column.width + apart;
  }
  all.width -= apart;
  const auto shifted = [](std::vector<double> heights, double by) {
    for (double& height : heights) height += by;
    return heights;
  };
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double y = columns[k].up - up - middle, end = begins[k] + columns[k].width;
    all.add(columns[k], {begins[k], y});
    const std::vector<double> entries = shifted(columns[k].entries, y), exits = shifted(columns[k].exits, y);
    if (k == 0)
      all.entries = entries;
    else
      all.wire(left, {{begins[k], top}, {begins[k], *std::max_element(entries.begin(), entries.end())}});
    if (k + 1 == columns.size())
      all.exits = exits;
    else
      all.wire(right, {{end, *std::min_element(exits.begin(), exits.end())}, {end, bottom}});
  }
  all.wire(left, {{0, top}, {begins.back(), top}});
  all.wire(right, {{begins.front() + columns.front().width, bottom}, {all.width, bottom}});
  all.entries.push_back(top);
  all.exits.push_back(bottom);
  all.up = std::max(all.up, -top);
  all.down = std::max(all.down, bottom);
  return all;
}

}  // namespace

Piece draw_parallel(const Draftsman& draftsman, const Block& block, double line) {
  const Detail& detail = draftsman.detail();
  std::vector<Piece> parts;
  double height = 0;
  for (const Block& part : block.parts) {
    parts.push_back(part.kind == Block::Kind::omitted ? omission(part) : draftsman.draw(part, line));
    height += parts.back().up + parts.back().down + detail.gap;
  }
  constexpr std::size_t least = 8;  // parts to a column: fewer are easier to follow below each other
  const auto count = static_cast<std::size_t>(std::ceil(height / detail.column));
  if (count <= 1 || parts.size() < least * count) return column(parts, block.left, block.right, detail.gap);
  std::vector<Piece> columns;
  for (std::size_t k = 0; k < count; ++k) {
    const auto from = parts.begin() + static_cast<std::ptrdiff_t>(k * parts.size() / count);
    const auto to = parts.begin() + static_cast<std::ptrdiff_t>((k + 1) * parts.size() / count);
    columns.push_back(column({from, to}, block.left, block.right, detail.gap));
  }
  return columns_of(columns, block.left, block.right);
}

}  // namespace rheonet::draw
