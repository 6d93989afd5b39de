#pragma once

#include <utility>
#include <vector>

namespace rheonet::draw {

/// A directed graph in layers from left to right.
struct Layers {
  /// A block, a source or a sink; or where a line that is longer than one layer passes through one.
  struct Item {
    double up = 0, down = 0;  ///< how far it reaches above and below its axis [px]
    int layer = 0;
    double y = 0;  ///< of its axis [px]
  };
  struct Line {
    int from, to;              ///< items
    double in = 0;             ///< where it comes in, from the axis of `to` [px]
    bool back = false;         ///< it leads from a later layer to an earlier one, or to the same
    std::vector<int> through;  ///< items that it passes
  };
  std::vector<Item> items;
  std::vector<Line> lines;
  std::vector<std::vector<int>> layers;  ///< items from top to bottom

  /// Finds layer and height of each item, few crossings, lines as straight as that allows: the method of K. Sugiyama,
  /// S. Tagawa and M. Toda (1981). Lines that close a loop lead back.
  void arrange();

 private:
  void find_loops();
  void find_layers();
  void split_long_lines();
  void order();
  void find_heights();
  void straighten(bool passing_too);
  void level_long_lines();
  /// Between which heights an item can go without coming too close to its neighbours.
  std::pair<double, double> room(int item) const;
};

}  // namespace rheonet::draw
