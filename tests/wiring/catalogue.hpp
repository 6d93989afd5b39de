#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/wiring/tree.hpp"

namespace rheonet::test {

/// A scene of the wiring test. The scenes and their order are the same on every machine.
struct Wiring {
  enum class Drive { velocity, position, force, force_on_mass };
  int number = 0;
  std::string name;    ///< As in `first in parallel with two in series(cfm, slider, cfm), force`.
  std::vector<std::string> types;  ///< For each leaf.
  std::optional<Tree> tree;        ///< Absent if the graph is not series-parallel.
  Graph graph;
  std::vector<char> massive;       ///< For each node: whether it has a mass.
  std::vector<char> rotating;      ///< For each node: whether it turns; empty if none does.
  Drive drive = Drive::velocity;
};

/// All scenes; the index of a scene is its number:
///  * every ordered pair and triple of the six laws in series, in parallel, and triples in each tree of three leaves; each
///    with masses at the nodes between and without, with each drive;
///  * random series-parallel trees of 4 to 8 leaves;
///  * random graphs that are not series-parallel;
///  * random trees of 2 to 6 leaves with a slider whose bounds vary, called `brake`, or with a freewheel;
///  * random trees with one or two elastic stops, and random graphs with one or two gears, whose support may move, and perhaps a stop;
///    with a mass at each node;
///  * random trees with a slider of Stribeck's curve;
///  * random graphs with one or two planetary gears, or gears with losses;
///  * random graphs of which some nodes turn, joined to the others by racks and screws.
/// The last three have a mass at each node.
const std::vector<Wiring>& catalogue();

/// The netlist of a wiring: generic values that depend only on its number, no two of them equal. `stop` is about 1 s and forces are about
/// 1 N; friction yields within a part of the motion, and the drive reverses several times.
std::string netlist_of(const Wiring& wiring);

/// The same with another graph for the same leaves, which keep their values and names.
std::string netlist_of(const Wiring& wiring, const Graph& graph);

/// `count` numbers spread over the whole catalogue, the same for the same seed.
std::vector<int> sample(int count, unsigned seed);

/// The numbers of part `i` of `n` (i = 0 .. n - 1), mixed, so that each part has scenes of every kind.
std::vector<int> part(int i, int n);

}  // namespace rheonet::test
