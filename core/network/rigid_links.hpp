#pragma once

#include <string>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// A slider that no force makes slip.
bool is_rigid_link(const Network::Slider& slider);

/// The nodes that rigid links join, of the whole network.
DisjointSets joined_by_links(const Network& network);

/// For each node: a marked node to which rigid links join it, itself if it is marked; -1 if there is none.
std::vector<NodeId> linked_to(const Network& network, const std::vector<char>& marked);

/// The rigid links on the shortest path between two nodes that they join, in words: "rigid link `l1`", "rigid links `l1`,
/// `l2`", "transmission `g1`".
struct LinksBetween {
  std::string words;
  int first;     ///< index into Scene::elements
  bool several;
};
LinksBetween links_between(const Network& network, NodeId from, NodeId to);

}  // namespace rheonet
