#pragma once

#include <string>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet::draw {

/// In px, 96 to the inch; y downwards.
struct Point {
  double x = 0, y = 0;
};

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;

  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

/// The symbol of an element.
struct Mark {
  /// Where it is joined to a node.
  struct End {
    NodeId node;
    Point at;
  };
  int element;            ///< Index into Scene::elements.
  Box box;                ///< The box of 1 x 1 of the symbol is mapped to it.
  bool mirrored = false;  ///< Left and right are exchanged.
  std::vector<End> ends;  ///< Blocks have none.
  double unit = 0;        ///< For a box that is stretched: see `fitted` [px].
  bool of_support = false;  ///< Only the support of a transmission.
  bool framed = false;    ///< The box is drawn, and the symbol within, as wide as the box and without its outline.
};

/// A wire between symbols: a rigid rod, all of which is one node.
struct Wire {
  NodeId node;
  std::vector<Point> points;  ///< horizontal and vertical pieces
  std::vector<double> hops;   ///< of a horizontal wire: the x at which it passes over others
};

/// Ground: hatched on its right side, or its left one.
struct Wall {
  double x, top, bottom;
  bool right;
};

/// A signal's way from block to block: ends in an arrow.
struct SignalLine {
  std::vector<Point> points;
  int from;  ///< index into Scene::blocks; -1: a quantity of the network
  bool arrow = true;
};

struct Label {
  enum class Kind { name, value, node, title };
  std::string text;
  Point at;  ///< of the baseline: its middle, or its start
  bool centred = true;
  double size = 12;  ///< of the letters [px]
  Kind kind = Kind::name;
  Box box() const;  ///< by the widths that plot::width_of estimates
};

/// A schematic, all of it placed.
struct Picture {
  double width = 0, height = 0;
  std::string title;
  std::size_t omitted = 0;  ///< Elements that repeat their neighbours and are left out.
  double stroke = 1.4;      ///< Width of the lines [px].
  std::vector<Mark> marks;
  std::vector<Wire> wires;
  std::vector<Wall> walls;
  std::vector<SignalLine> signals;
  std::vector<Label> labels;
  std::vector<Point> joints;  ///< dots, where more than two wires or lines meet

  /// Adds all of another picture, moved.
  void add(const Picture& other, Point by);
};

/// As an SVG document. The scene is the one that was drawn.
std::string svg(const Picture& picture, const Scene& scene);

}  // namespace rheonet::draw
