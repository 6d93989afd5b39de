#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// Nodes that independent parts of a scene may share: ground alone, or also nodes whose motion is a given function of time.
enum class Between { ground, ground_and_given_motions };

/// The independent parts of a scene: what happens in one has no effect on the others.
struct Parts {
  int count = 0;
  std::vector<int> of_element;  ///< -1: all its nodes are shared (a motion, a mass that it moves): in no part
  std::vector<int> of_node;     ///< -1: shared
};

/// Parts are numbered in the order in which the elements name them. What blocks take in and act on is one part with them;
/// `without` marks blocks that are not looked at, and are part of none (empty: all are looked at).
Parts find_parts(const Scene& scene, const std::vector<char>& without = {}, Between between = Between::ground_and_given_motions);

}  // namespace rheonet
