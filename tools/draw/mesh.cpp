#include <algorithm>

#include "tools/draw/draftsman.hpp"
#include "tools/draw/mesh_order.hpp"

namespace rheonet::draw {
namespace {

constexpr double row_gap = 14, column_gap = 8;

/// Stations as vertical bars from left to right, and links as rows between them, one gap between stations wide.
class MeshDrawing {
 public:
  MeshDrawing(const Draftsman& draftsman, const Mesh& mesh)
      : draftsman_(draftsman), mesh_(mesh), rows_(rows_of(mesh)), bars_(bars_of(mesh, rows_)) {
    for (const Mesh::Link& link : mesh.links) pieces_.push_back(draftsman.draw(link.block));
    for (std::size_t c = 0; c < mesh.stations.size(); ++c) places_.push_back(place(c));
    choose_gaps();
    find_columns();
    find_rows();
  }

  Piece draw() const {
    Piece all;
    all.width = columns_.back() + draftsman_.stand(mesh_.stations.back().node, places_.back()).width;
    for (std::size_t c = 0; c < mesh_.stations.size(); ++c) station(all, c);
    for (std::size_t k = 0; k < mesh_.links.size(); ++k) link(all, k);
    return all;
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  double height(std::size_t link) const { return heights_[at(rows_[link])]; }

  Draftsman::Place place(std::size_t c) const { return {0, 0, c == 0, c + 1 == mesh_.stations.size(), false}; }

  /// A link is drawn in one of the gaps that it leads through: where there is room, else in the one that is widest.
  void choose_gaps() {
    gap_widths_.assign(mesh_.stations.size(), 0);
    for (std::size_t k = 0; k < mesh_.links.size(); ++k) {
      const Mesh::Link& link = mesh_.links[k];
      int best = link.left;
      for (int gap = link.left + 1; gap < link.right; ++gap)
        if (gap_widths_[at(gap)] > gap_widths_[at(best)]) best = gap;
      gaps_.push_back(best);
      gap_widths_[at(best)] = std::max(gap_widths_[at(best)], pieces_[k].width + 2 * column_gap);
    }
  }

  void find_columns() {
    double x = 0;
    for (std::size_t c = 0; c < mesh_.stations.size(); ++c) {
      const Draftsman::Stand stand = draftsman_.stand(mesh_.stations[c].node, places_[c]);
      columns_.push_back(x);
      edges_.push_back(x + stand.width);
      x += stand.width + gap_widths_[c];
    }
  }

  void find_rows() {
    const std::size_t count = at(*std::max_element(rows_.begin(), rows_.end())) + 1;
    std::vector<double> up(count), down(count);
    for (std::size_t k = 0; k < mesh_.links.size(); ++k) {
      const Piece& piece = pieces_[k];
      double& above = up[at(rows_[k])];
      double& below = down[at(rows_[k])];
      above = std::max(above, piece.up);
      below = std::max(below, piece.down);
      for (const int c : {mesh_.links[k].left, mesh_.links[k].right}) {
        if (c < 0) continue;
        const Draftsman::Stand stand = draftsman_.stand(mesh_.stations[at(c)].node, places_[at(c)]);
        above = std::max(above, stand.up);
        below = std::max(below, stand.down);
      }
    }
    heights_.assign(count, 0);
    for (std::size_t r = 1; r < count; ++r) heights_[r] = heights_[r - 1] + down[r - 1] + row_gap + up[r];
  }

  /// The heights at which a station is joined to its links.
  std::vector<double> joints(std::size_t c) const {
    std::vector<double> found;
    for (std::size_t k = 0; k < mesh_.links.size(); ++k) {
      if (at(mesh_.links[k].left) == c) found.push_back(height(k));
      if (mesh_.links[k].right == static_cast<int>(c)) found.push_back(height(k) + pieces_[k].exit);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  Draftsman::Stand stand(std::size_t c, double& axis) const {
    const std::vector<double> found = joints(c);
    axis = found[found.size() / 2];
    Draftsman::Place place = places_[c];
    place.low = found.front() - axis;
    place.high = found.back() - axis;
    return draftsman_.stand(mesh_.stations[c].node, place);
  }
  double bar(int c) const {
    double axis = 0;
    return columns_[at(c)] + stand(at(c), axis).bar;
  }

  void station(Piece& all, std::size_t c) const {
    double axis = 0;
    const Draftsman::Stand drawn = stand(c, axis);
    all.add(drawn, {columns_[c], axis});
  }

  void link(Piece& all, std::size_t k) const {
    const Mesh::Link& link = mesh_.links[k];
    const Piece& piece = pieces_[k];
    const double y = height(k), exit = y + piece.exit;
    const double room = gap_widths_[at(gaps_[k])] - piece.width;
    const double left = edges_[at(gaps_[k])] + room / 2, right = left + piece.width;
    all.add(piece, {left, y});
    own_bar(all, link.block.left, left, y, piece.entries);
    all.wire(link.block.left, {{bar(link.left), y}, {left, y}});
    hops(all, k, link.left, gaps_[k] + 1);
    if (link.right < 0) return;
    own_bar(all, link.block.right, right, y, piece.exits);
    all.wire(link.block.right, {{right, exit}, {bar(link.right), exit}});
    hops(all, k, gaps_[k] + 1, link.right);
  }

  /// For a piece that is joined at several heights.
  static void own_bar(Piece& all, NodeId node, double x, double y, const std::vector<double>& ends) {
    const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
    if (ends.size() > 1) all.wire(node, {{x, y + *low}, {x, y + *high}});
  }

  /// Where the wire drawn last leads over the bars of the stations from `begin` to before `end`.
  void hops(Piece& all, std::size_t k, int begin, int end) const {
    for (int c = begin; c < end; ++c)
      if (crosses(mesh_.links[k], rows_[k], c, bars_)) all.ink.wires.back().hops.push_back(bar(c));
  }

  const Draftsman& draftsman_;
  const Mesh& mesh_;
  std::vector<int> rows_;
  std::vector<BarSpan> bars_;
  std::vector<Piece> pieces_;
  std::vector<Draftsman::Place> places_;
  std::vector<int> gaps_;
  std::vector<double> gap_widths_, columns_, edges_, heights_;
};

}  // namespace

Piece draw_mesh(const Draftsman& draftsman, const Mesh& mesh) { return MeshDrawing(draftsman, mesh).draw(); }

}  // namespace rheonet::draw
