#include "core/network/adjacent_elements.hpp"

#include "core/base/index.hpp"

namespace rheonet {

std::vector<std::string> elements_at(const Network& network, const std::vector<NodeId>& nodes) {
  std::vector<char> meant(network.nodes(), 0);
  for (const NodeId node : nodes) meant[at(node)] = node != ground;
  const auto touches = [&](NodeId scene_node) {
    const int node = network.node_of[at(scene_node)];
    return node >= 0 && meant[at(node)];
  };
  std::vector<std::string> names;
  for (const SceneElement& e : network.scene->elements) {
    bool there = false;
    for_each_node(e, [&](NodeId node) { there = there || touches(node); });
    if (there) names.push_back(e.name);
  }
  return names;
}

std::vector<int> elements_with_friction(const Network& network) {
  std::vector<char> meant(network.scene->elements.size(), 0);
  for (const Network::Slider& s : network.sliders) meant[at(s.branch.element)] = 1;
  for (const Pair& pair : network.pairs) meant[at(pair.slider)] = 1;
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->events(i) > 0) meant[at(network.deflections[at(laws.first) + i].element)] = 1;
    }
  }
  std::vector<int> elements;
  for (std::size_t e = 0; e < meant.size(); ++e) {
    if (meant[e]) elements.push_back(static_cast<int>(e));
  }
  return elements;
}

}  // namespace rheonet
