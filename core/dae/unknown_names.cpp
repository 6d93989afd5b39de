#include "core/dae/unknown_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/network/adjacent_elements.hpp"

namespace rheonet {

UnknownNames::Subject UnknownNames::subject(int unknown) const {
  const auto index_of = [unknown](const std::vector<int>& unknowns) {
    return static_cast<std::size_t>(std::find(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
  };
  using enum Subject::Kind;
  if (const std::size_t n = index_of(dae_.indices().velocity); n < dae_.indices().velocity.size()) return {node, dae_.network().scene_node[n]};
  if (const std::size_t n = index_of(dae_.indices().position); n < dae_.indices().position.size()) return {node, dae_.network().scene_node[n]};
  if (const std::size_t j = index_of(dae_.indices().deflection); j < dae_.indices().deflection.size()) return {element, dae_.network().deflections[j].element};
  if (const std::size_t r = index_of(dae_.indices().force); r < dae_.indices().force.size()) return {element, dae_.network().rates[r].element};
  if (const std::size_t s = index_of(dae_.indices().block); s < dae_.indices().block.size()) return {element, dae_.network().blocks.blocks[at(dae_.inputs().blocks().block_of_state(s))].element};
  throw std::logic_error(fmt::format("unknown {} belongs to no node and no element", unknown));
}

std::string UnknownNames::describe(int unknown) const {
  const auto is = [unknown](const std::vector<int>& unknowns) {
    return std::find(unknowns.begin(), unknowns.end(), unknown) != unknowns.end();
  };
  const Scene& scene = *dae_.network().scene;
  const auto [kind, index] = subject(unknown);
  if (kind == Subject::Kind::node) {
    return fmt::format("the {} of node `{}`", is(dae_.indices().velocity) ? "velocity" : "position", scene.nodes[at(index)].name);
  }
  return fmt::format("the {} of `{}`", is(dae_.indices().block) ? "output" : "force", scene.elements[at(index)].name);
}

const Spot& UnknownNames::spot_of(int unknown) const {
  const auto [kind, index] = subject(unknown);
  return kind == Subject::Kind::node ? dae_.network().scene->nodes[at(index)].spot : dae_.network().scene->elements[at(index)].spot;
}

std::string UnknownNames::around(int unknown) const {
  const Scene& scene = *dae_.network().scene;
  const auto [kind, index] = subject(unknown);
  std::vector<NodeId> ends{index};
  if (kind == Subject::Kind::element) ends = {scene.elements[at(index)].a, scene.elements[at(index)].b};
  std::vector<NodeId> nodes;
  for (const NodeId end : ends) {
    if (const int node = dae_.network().node_of[at(end)]; node >= 0) nodes.push_back(node);
  }
  std::vector<std::string> names = elements_at(dae_.network(), nodes);
  // A block touches no node, and an element between motions may touch none.
  if (names.empty() && kind == Subject::Kind::element) names = {scene.elements[at(index)].name};
  return format_list(names);
}

}  // namespace rheonet
