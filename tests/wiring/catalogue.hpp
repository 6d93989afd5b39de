#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/wiring/tree.hpp"

namespace rheonet::test {

/// The scenes of the wiring test. Which there are, and in which order, never depends on the machine.
struct Wiring {
  enum class Drive { velocity, position, force, force_on_mass };
  int number = 0;
  std::string name;    ///< `first in parallel with two in series(cfm, slider, cfm), force`
  std::vector<std::string> types;  ///< of each leaf
  std::optional<Tree> tree;        ///< absent if the graph is not series-parallel
  Graph graph;
  std::vector<char> massive;       ///< of each node
  Drive drive = Drive::velocity;
};

/// All scenes; the index of a scene is its number:
///  * every ordered pair and triple of the six laws in series, in parallel, and triples in each tree of three leaves; each
///    with masses at the nodes between and without, with each drive;
///  * random series-parallel trees of 4 to 8 leaves;
///  * random graphs that are not series-parallel;
///  * random trees of 2 to 6 leaves with a slider whose bounds vary, called `brake`, or with a freewheel;
///  * random trees with one or two elastic stops, and random graphs with one or two gears, whose support may move, and perhaps a stop;
///    with a mass at each node.
const std::vector<Wiring>& catalogue();

/// The netlist of a wiring: generic values that follow from its number, no two of them equal. `stop` is about 1 s, forces
/// are about 1 N, what yields does so within some of the motion, and the drive turns back several times.
std::string netlist_of(const Wiring& wiring);

/// The same with another graph for the same leaves, which keep their values and names.
std::string netlist_of(const Wiring& wiring, const Graph& graph);

/// `count` numbers spread over the whole catalogue, the same for the same seed.
std::vector<int> sample(int count, unsigned seed);

/// The numbers of part `i` of `n` (i = 0 .. n - 1), mixed, so that each part has scenes of every kind.
std::vector<int> part(int i, int n);

}  // namespace rheonet::test
