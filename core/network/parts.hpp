#pragma once

#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet {

/// The parts of a scene that know nothing of each other: they share at most ground, and nodes whose motion is a given function
/// of time (Between::ground: at most ground).
struct Parts {
  int count = 0;
  std::vector<int> of_element;  ///< -1: it stands at such nodes alone (a motion, a mass that it moves): part of none
  std::vector<int> of_node;     ///< -1: ground, and nodes whose motion is given
};

/// Through which nodes parts still know nothing of each other.
enum class Between { ground, ground_and_given_motions };

/// Parts are numbered in the order in which the elements name them. What blocks take in and act on is one part with them;
/// `without` marks blocks that are not looked at, and are part of none (empty: all are looked at).
Parts find_parts(const Scene& scene, const std::vector<char>& without = {}, Between between = Between::ground_and_given_motions);

}  // namespace rheonet
