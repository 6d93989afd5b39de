#pragma once

#include <string>
#include <vector>

#include "core/network/network.hpp"

namespace rheonet {

/// The names of the elements that touch any of these nodes, in the order of the scene. What touches ground alone is not
/// among them.
std::vector<std::string> elements_at(const Network& network, const std::vector<NodeId>& nodes);

/// The elements that may stick or slip, turn or stand: sliders and friction. Indices into Scene::elements.
std::vector<int> elements_with_friction(const Network& network);

}  // namespace rheonet
