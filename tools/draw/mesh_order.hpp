#pragma once

#include <vector>

#include "tools/draw/network_tree.hpp"

namespace rheonet::draw {

/// Puts the stations of a mesh in an order in which the ways between them are short, `start` first, a ground (which is
/// the last station) last, and turns the links to run from left to right.
void put_in_order(Mesh& mesh, int start, bool grounded);

/// The row in which each link is drawn, 0 on top: links of one row do not overlap, and few links lead over the bars of
/// stations, which reach from the first to the last row of their links. Found by local search.
std::vector<int> rows_of(const Mesh& mesh);

/// The first and the last row that the bar of a station reaches.
struct BarSpan {
  int top, bottom;
};
std::vector<BarSpan> bars_of(const Mesh& mesh, const std::vector<int>& rows);

/// Whether a link in `row` leads over the bar of a station.
bool crosses(const Mesh::Link& link, int row, int station, const std::vector<BarSpan>& bars);

}  // namespace rheonet::draw
