#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/base/format_list.hpp"
#include "core/dae/dae.hpp"
#include "core/network/adjacent_elements.hpp"

namespace rheonet {

Dae::Subject Dae::subject(int unknown) const {
  const auto index_of = [unknown](const std::vector<int>& unknowns) {
    return static_cast<std::size_t>(std::find(unknowns.begin(), unknowns.end(), unknown) - unknowns.begin());
  };
  using enum Subject::Kind;
  if (const std::size_t n = index_of(iv_); n < iv_.size()) return {node, network_->scene_node[n]};
  if (const std::size_t n = index_of(ix_); n < ix_.size()) return {node, network_->scene_node[n]};
  if (const std::size_t j = index_of(ip_); j < ip_.size()) return {element, network_->deflections[j].element};
  if (const std::size_t r = index_of(if_); r < if_.size()) return {element, network_->rates[r].element};
  if (const std::size_t s = index_of(iz_); s < iz_.size()) return {element, network_->blocks.blocks[at(inputs_->blocks().block_of_state(s))].element};
  throw std::logic_error(fmt::format("unknown {} belongs to no node and no element", unknown));
}

std::string Dae::describe(int unknown) const {
  const auto is = [unknown](const std::vector<int>& unknowns) {
    return std::find(unknowns.begin(), unknowns.end(), unknown) != unknowns.end();
  };
  const Scene& scene = *network_->scene;
  const auto [kind, index] = subject(unknown);
  if (kind == Subject::Kind::node) {
    return fmt::format("the {} of node `{}`", is(iv_) ? "velocity" : "position", scene.nodes[at(index)].name);
  }
  return fmt::format("the {} of `{}`", is(iz_) ? "output" : "force", scene.elements[at(index)].name);
}

const Spot& Dae::spot_of(int unknown) const {
  const auto [kind, index] = subject(unknown);
  return kind == Subject::Kind::node ? network_->scene->nodes[at(index)].spot : network_->scene->elements[at(index)].spot;
}

std::string Dae::around(int unknown) const {
  const Scene& scene = *network_->scene;
  const auto [kind, index] = subject(unknown);
  std::vector<NodeId> ends{index};
  if (kind == Subject::Kind::element) ends = {scene.elements[at(index)].a, scene.elements[at(index)].b};
  std::vector<NodeId> nodes;
  for (const NodeId end : ends) {
    if (const int node = network_->node_of[at(end)]; node >= 0) nodes.push_back(node);
  }
  std::vector<std::string> names = elements_at(*network_, nodes);
  // A block touches no node, and an element between motions may touch none.
  if (names.empty() && kind == Subject::Kind::element) names = {scene.elements[at(index)].name};
  return format_list(names);
}

}  // namespace rheonet
