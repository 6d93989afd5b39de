#pragma once

#include <string>
#include <vector>

#include "core/network/network.hpp"
#include "core/network/sets.hpp"

namespace rheonet {

/// A slider that no force lets slip.
bool is_rigid_link(const Network::Slider& slider);

/// The nodes that rigid links join, of the whole network.
Sets joined_by_links(const Network& network);

/// In words, the rigid links on the shortest way from one node to another that they join: "rigid link `l1`", "rigid links
/// `l1`, `l2`".
struct LinksBetween {
  std::string words;
  int first;     ///< index into Scene::elements
  bool several;
};
LinksBetween links_between(const Network& network, NodeId from, NodeId to);

}  // namespace rheonet
