#pragma once

#include <string>
#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// The names of the elements that touch any of these nodes, in the order of the scene. `ground` among the nodes is ignored.
std::vector<std::string> elements_at(const Network& network, const std::vector<NodeId>& nodes);

/// The elements with stick-slip or reversals: sliders and friction laws. Indices into Scene::elements.
std::vector<int> elements_with_friction(const Network& network);

}  // namespace rheonet
