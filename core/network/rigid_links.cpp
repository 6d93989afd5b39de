#include "core/network/rigid_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"

namespace rheonet {

bool is_rigid_link(const Network::Slider& slider) { return slider.varying.empty() && slider.box.rigid(); }

DisjointSets joined_by_links(const Network& network) {
  DisjointSets joined(network.nodes());
  for (const Network::Slider& s : network.sliders) {
    if (is_rigid_link(s)) joined.join(s.branch.a, s.branch.b);
  }
  return joined;
}

std::vector<NodeId> linked_to(const Network& network, const std::vector<char>& marked) {
  DisjointSets joined = joined_by_links(network);
  std::vector<NodeId> of_set(marked.size(), -1), result(marked.size());
  for (std::size_t n = 0; n < marked.size(); ++n) {
    if (marked[n]) of_set[at(joined.find(static_cast<NodeId>(n)))] = static_cast<NodeId>(n);
  }
  for (std::size_t n = 0; n < marked.size(); ++n) result[n] = marked[n] ? static_cast<NodeId>(n) : of_set[at(joined.find(static_cast<NodeId>(n)))];
  return result;
}

LinksBetween links_between(const Network& network, NodeId from, NodeId to) {
  std::vector<std::vector<const Branch*>> around(network.nodes());
  for (const Network::Slider& s : network.sliders) {
    if (!is_rigid_link(s)) continue;
    around[at(s.branch.a)].push_back(&s.branch);
    around[at(s.branch.b)].push_back(&s.branch);
  }
  const auto beyond = [](const Branch& link, NodeId node) { return link.a == node ? link.b : link.a; };
  std::vector<const Branch*> by(network.nodes(), nullptr);
  std::vector<NodeId> reached{from};
  for (std::size_t k = 0; k < reached.size() && !by[at(to)]; ++k) {
    for (const Branch* link : around[at(reached[k])]) {
      const NodeId next = beyond(*link, reached[k]);
      if (next == from || by[at(next)]) continue;
      by[at(next)] = link;
      reached.push_back(next);
    }
  }
  std::vector<std::string> names;
  std::size_t transmissions = 0;
  int first = -1;
  for (NodeId node = to; node != from && by[at(node)]; node = beyond(*by[at(node)], node)) {
    first = by[at(node)]->element;
    transmissions += components()[at(network.element_of(*by[at(node)]).declaration)]->ratio ? 1 : 0;
    names.push_back(network.name_of(*by[at(node)]));
  }
  std::reverse(names.begin(), names.end());
  const bool several = names.size() > 1;
  const char* const what = transmissions == 0 ? "rigid link" : transmissions == names.size() ? "transmission" : "rigid or transmitting link";
  return {fmt::format("{}{} {}", what, several ? "s" : "", format_list(names)), first, several};
}

}  // namespace rheonet
