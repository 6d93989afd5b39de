#include <algorithm>
#include <optional>

#include "tools/draw/draftsman.hpp"

namespace rheonet::draw {
namespace {

constexpr double gutter = 12;  // beside lines and between them, where a wire leads from the end of one to the next

/// A station and the part behind it, with the parts that hang from the station below that part.
struct Section {
  const Station* station = nullptr;
  bool drawn = false;
  std::optional<Piece> part;
  NodeId behind = ground;  ///< the node at the end of the part
  std::vector<Piece> hanging;
  double beside = 0;  ///< Width of the part or, if they are wider, of the hanging parts.
};

class Row {
 public:
  Row(const Draftsman& draftsman, const Block& block, double line) : draftsman_(draftsman), block_(block), most_(line) {
    // Leaves room for the parts before and behind parallel ones.
    const double inner = block.parts.size() > 1 ? std::max(0.65 * line, 0.4 * draftsman.detail().line) : line;
    for (std::size_t k = 0; k < block.stations.size(); ++k) {
      Section section;
      section.station = &block.stations[k];
      section.drawn = (k > 0 || block.opens) && (k + 1 < block.stations.size() || block.closes);
      if (k < block.parts.size()) {
        section.part = draftsman.draw(block.parts[k], inner);
        section.behind = block.stations[k + 1].node;
        section.beside = section.part->width;
      }
      for (const Block& way : block.stations[k].hanging) {
        section.hanging.push_back(draftsman.draw(way, line));
        section.beside = std::max(section.beside, section.hanging.back().width);
      }
      sections_.push_back(std::move(section));
    }
  }

  Piece draw() {
    double all = 0, widest = 0;
    for (std::size_t k = 0; k < sections_.size(); ++k) {
      widths_.push_back(width(k));
      all += widths_.back();
      widest = std::max(widest, widths_.back());
    }
    constexpr double a_little_more = 1.1;  // is better than a line with hardly anything on it
    if (all <= a_little_more * most_) return line(0, sections_.size());
    // As few lines as there must be, all about as long.
    const std::size_t count = begins_of(most_).size();
    double length = std::max(all / static_cast<double>(count), widest);
    while (length < most_ && begins_of(length).size() > count) length *= 1.02;
    begins_ = begins_of(std::min(length, most_));
    std::vector<Piece> lines;
    for (std::size_t i = 0; i < begins_.size(); ++i)
      lines.push_back(line(begins_[i], i + 1 < begins_.size() ? begins_[i + 1] : sections_.size()));
    return stacked(lines);
  }

 private:
  bool first(std::size_t k) const { return k == 0; }
  bool last(std::size_t k) const { return k + 1 == sections_.size(); }

  double width(std::size_t k) const {
    const Section& section = sections_[k];
    const double stand = section.drawn ? draftsman_.stand(section.station->node, {0, 0, first(k), last(k)}).width : 0;
    return stand + section.beside;
  }

  /// Where lines begin that are no longer than that, unless a single section is.
  std::vector<std::size_t> begins_of(double length) const {
    std::vector<std::size_t> begins{0};
    double wide = 0;
    for (std::size_t k = 0; k < sections_.size(); ++k) {
      wide += widths_[k];
      // The last station stays with the part that leads to it.
      if (k == begins.back() || wide <= length || last(k)) continue;
      begins.push_back(k);
      wide = widths_[k];
    }
    return begins;
  }

  /// Sections one after the other; what the first and the last are joined to is left open.
  Piece line(std::size_t begin, std::size_t end) const {
    Piece piece;
    double x = 0, axis = 0;
    std::vector<double> exits{0};  // of the part before, from its axis
    for (std::size_t k = begin; k < end; ++k) {
      const Section& section = sections_[k];
      std::vector<double> right, hung;
      if (section.part) right = section.part->entries;
      double below = section.part ? section.part->down : 0;
      for (const Piece& way : section.hanging) {
        hung.push_back(below + draftsman_.detail().gap + way.up);
        below = hung.back() + way.down;
        for (const double entry : way.entries) right.push_back(hung.back() + entry);
      }
      if (section.drawn) {
        stand(piece, k, {x, axis}, first(k) ? std::vector<double>{} : exits, right);
        x += width(k) - section.beside;
      } else if (k == begin && first(k)) {
        piece.entries = right;
      }
      if (section.drawn) exits = {0};
      if (section.part) {
        piece.add(*section.part, {x, axis});
        exits = beside(piece, section, {x, axis});
      }
      for (std::size_t i = 0; i < hung.size(); ++i) piece.add(section.hanging[i], {x, axis + hung[i]});
      x += section.beside;
      if (section.part) axis += section.part->exit;
    }
    piece.width = x;
    piece.exit = axis;
    piece.exits.clear();
    for (const double exit : exits) piece.exits.push_back(axis + exit);
    return piece;
  }

  /// Joins a part to the right end of its section; where that is to be joined, from the axis of its exit.
  std::vector<double> beside(Piece& piece, const Section& section, Point at) const {
    const Piece& part = *section.part;
    std::vector<double> exits;
    for (const double exit : part.exits) exits.push_back(exit - part.exit);
    const double slack = section.beside - part.width, y = at.y + part.exit;
    if (slack < 0.01) return exits;
    const double end = at.x + part.width;
    piece.wire(section.behind, {{end, y}, {at.x + section.beside, y}});
    bar(piece, section.behind, end, y, exits);
    return {0};
  }

  static void bar(Piece& piece, NodeId node, double x, double y, const std::vector<double>& ends) {
    const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
    if (ends.size() > 1) piece.wire(node, {{x, y + *low}, {x, y + *high}});
  }

  /// A station, joined to the parts on both its sides.
  void stand(Piece& piece, std::size_t k, Point at, const std::vector<double>& left,
             const std::vector<double>& right) const {
    Draftsman::Place place{0, 0, first(k), last(k)};
    for (const auto* heights : {&left, &right})
      for (const double y : *heights) {
        place.low = std::min(place.low, y);
        place.high = std::max(place.high, y);
      }
    const NodeId node = sections_[k].station->node;
    const Draftsman::Stand stand = draftsman_.stand(node, place);
    piece.add(stand, at);
    for (const double y : left) piece.wire(node, {{at.x, at.y + y}, {at.x + stand.bar, at.y + y}});
    for (const double y : right) piece.wire(node, {{at.x + stand.bar, at.y + y}, {at.x + stand.width, at.y + y}});
  }

  /// Lines below each other, the end of each joined to the beginning of the next.
  Piece stacked(const std::vector<Piece>& lines) const {
    Piece all;
    double widest = 0;
    for (const Piece& line : lines) widest = std::max(widest, line.width);
    all.width = widest + 2 * gutter;
    double y = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Piece& line = lines[i];
      const NodeId before = sections_[begins_[i]].station->node;
      const bool opens = i == 0 && block_.opens, closes = i + 1 == lines.size() && block_.closes;
      const double end = gutter + line.width, exit = y + line.exit;
      all.add(line, {gutter, y});
      if (i == 0 && !opens) {
        all.wire(before, {{0, y}, {gutter, y}});
        bar(all, before, gutter, y, line.entries);
      }
      if (i + 1 == lines.size()) {
        if (!closes) {
          all.wire(block_.stations.back().node, {{end, exit}, {all.width, exit}});
          bar(all, block_.stations.back().node, end, y, line.exits);
        }
        all.exit = exit;
        all.exits = {exit};
        break;
      }
      const NodeId node = sections_[begins_[i + 1]].station->node;
      const double between = y + line.down + gutter, next = between + gutter + lines[i + 1].up;
      const double left = gutter / 3, right = all.width - gutter / 3;
      bar(all, node, end, y, line.exits);
      all.wire(node, {{end, exit}, {right, exit}, {right, between}, {left, between}, {left, next}, {gutter, next}});
      y = next;
    }
    return all;
  }

  const Draftsman& draftsman_;
  const Block& block_;
  double most_;  ///< width of a line
  std::vector<Section> sections_;
  std::vector<double> widths_;
  std::vector<std::size_t> begins_;  ///< first sections of the lines
};

}  // namespace

Piece draw_row(const Draftsman& draftsman, const Block& row, double line) { return Row(draftsman, row, line).draw(); }

}  // namespace rheonet::draw
