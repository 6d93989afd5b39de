#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Nodes that independent parts may share: ground alone, or also nodes whose motion is a given function of time.
enum class Between { ground, ground_and_given_motions };

/// The independent parts of a scene: events in one do not affect the others.
struct Parts {
  int count = 0;
  std::vector<int> of_element;  ///< -1: in no part, because all its nodes are shared (a motion, or a mass that it moves)
  std::vector<int> of_node;     ///< -1: shared
};

/// Parts are numbered in the order in which elements name them. A block is in one part with the elements and nodes that it
/// senses and drives; `without` marks blocks to ignore, which are in no part (empty: none).
Parts find_parts(const Scene& scene, const std::vector<char>& without = {}, Between between = Between::ground_and_given_motions);

}  // namespace rheonet
