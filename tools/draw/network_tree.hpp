#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet::draw {

struct Block;

/// A node on a drawing's way from left to right.
struct Station {
  NodeId node = ground;
  std::vector<Block> hanging;  ///< ways that begin here and lead nowhere else
};

/// A part of a network between two nodes: one element, several parts in parallel or in a row, or
/// repetitions of a neighbour, which are left out.
struct Block {
  enum class Kind { element, parallel, series, omitted };

  Kind kind = Kind::element;
  NodeId left = ground, right = ground;
  int element = -1;
  bool of_support = false;             ///< between the second node of a transmission and its support
  int times = 0;                       ///< If omitted: how often its neighbour is repeated.
  std::vector<Block> parts;            ///< in parallel from top to bottom, in a row from left to right
  std::vector<Station> stations;       ///< of a row: one before each part, and one behind the last
  bool opens = false, closes = false;  ///< its first, its last station belongs to it; else to what it is part of

  static Block of_element(int element, NodeId left, NodeId right);
  /// A row of one station.
  static Block of_node(NodeId node);
  /// Two blocks in a row; `middle` is the station between.
  static Block in_series(Block first, Station middle, Block second);
  static Block in_parallel(Block first, Block second);
  /// A part with the stations at its ends.
  static Block in_row(Station first, Block part, Station last, bool opens, bool closes);
  /// The same seen from behind.
  void reverse();
  int first_element() const;  ///< the least index in it
  int levels() const;         ///< parallel parts within each other
};

/// A network that series and parallel do not reduce: stations with blocks between any two of them.
struct Mesh {
  struct Link {
    int left, right;  ///< indices into stations, left < right; right is -1 for a way that leads nowhere else
    Block block;
  };
  std::vector<Station> stations;  ///< from left to right; a ground is the last
  std::vector<Link> links;
};

/// The parts of a network that only ground joins, each a row or, if it cannot be, a mesh. Ground stands in them as
/// often as is convenient, like in a circuit diagram.
struct Forest {
  std::vector<Block> rows;
  std::vector<Mesh> meshes;
};

/// Finds the order in which a network is drawn. Drives are to the left and ground is to the right. A row is turned round if most of its
/// stops would strike on the wrong side. Deterministic.
Forest forest_of(const Scene& scene);

}  // namespace rheonet::draw
