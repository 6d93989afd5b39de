#pragma once

#include <string>
#include <vector>

#include "tools/draw/literals.hpp"
#include "tools/draw/network_tree.hpp"
#include "tools/draw/picture.hpp"

namespace rheonet::draw {

/// How much of a network is shown, and how large.
struct Detail {
  bool names = true, values = true, nodes = true;
  double symbol = 60;   ///< Side of the box of a symbol between two nodes [px].
  double drive = 40;    ///< Side of the box of a motion or force [px].
  double gap = 8;       ///< Between parallel parts [px].
  double line = 1000;   ///< Width beyond which a row goes on below [px].
  double column = 900;  ///< Height beyond which parallel parts go on beside [px].
  Typed typed = {};     ///< Units of the values in the files.
};

/// A part of a drawing. Its origin is on its left edge, where it is entered; nodes on its edges are left to whoever
/// joins it to others: they are to be joined at all of `entries` and `exits`.
struct Piece {
  Picture ink;
  double width = 0;
  double up = 0, down = 0;         ///< how far it reaches above and below its origin
  double exit = 0;                 ///< height of the axis on which it is left
  std::vector<double> entries{0};  ///< heights
  std::vector<double> exits{0};    ///< heights, counted from the origin

  /// Adds another piece at a place, and makes room for it above and below.
  void add(const Piece& other, Point at);
  /// Adds a wire, if it leads anywhere.
  void wire(NodeId node, std::vector<Point> points);
};

/// Draws nodes and the parts between them. A wire of a node reaches every element of the node.
class Draftsman {
 public:
  Draftsman(const Scene& scene, const Detail& detail);

  /// A row in it that is wider than `line` goes on below.
  Piece draw(const Block& block, double line) const;
  Piece draw(const Block& block) const { return draw(block, detail_.line); }

  /// The picture of a node, and its place: all parts are joined to it at `bar`.
  struct Stand : Piece {
    double bar = 0;
  };
  /// The neighbours of a stand: nothing to its left means that drives may come from there.
  struct Place {
    double low = 0, high = 0;  ///< heights that its bar spans, 0 among them
    bool first = false, last = false;
    bool stretched = true;  ///< a mass reaches over all of the bar; else wires pass over the bar, which must be seen
  };
  Stand stand(NodeId node, const Place& place) const;

  const Detail& detail() const { return detail_; }

 private:
  Piece element(const Block& block) const;
  Piece omission_in_row(const Block& block) const;
  Stand wall(const Place& place) const;
  void drive(Stand& stand, int element, bool from_left) const;
  void drive_above(Stand& stand, int element, double& top) const;
  double body(Stand& stand, NodeId node, int element, const Place& place) const;

  const Scene& scene_;
  Detail detail_;
  std::vector<std::vector<int>> bodies_, drives_;  ///< elements at each node
};

/// From a symbol to the baseline of the name above it: letters reach below that.
inline constexpr double name_gap = 6;  // px
inline constexpr double line_height = 14;  // px, of a line of names or values

/// A row, broken into lines where it is wider than `line`.
Piece draw_row(const Draftsman& draftsman, const Block& row, double line);
/// The label of parts that are left out: "96 more".
Label omission_label(int times, Point middle);

/// Parts in parallel below each other; in columns, where they are very many.
Piece draw_parallel(const Draftsman& draftsman, const Block& block, double line);
/// A mesh.
Piece draw_mesh(const Draftsman& draftsman, const Mesh& mesh);

}  // namespace rheonet::draw
