#include "core/solve/balanced_forces.hpp"

#include <algorithm>

namespace rheonet {

namespace {

struct Node {
  int open = 0;                      ///< number of its forces that are not determined yet
  bool any = false;                  ///< its balance determines no force
  std::vector<std::size_t> forces;   ///< all its forces that have to be determined
};

}  // namespace

void BalancedForces::attach(const Structure& structure, std::vector<Branch> forces, std::size_t otherwise) {
  forces_ = std::move(forces);
  order_.clear();
  at_node_.resize(structure.kind.size());
  noise_.resize(forces_.size());
  std::vector<Node> nodes(structure.kind.size());
  // A mass or a prescribed motion balances any force.
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n].any = structure.kind[n] == Kind::known || structure.inertia[n] > 0;
  std::vector<char> found(forces_.size(), 0);
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const Branch& b = forces_[k];
    found[k] = b.a == b.b;
    if (found[k]) continue;
    for (const NodeId node : {b.a, b.b}) {
      nodes[at(node)].forces.push_back(k);
      ++nodes[at(node)].open;
    }
  }
  std::vector<NodeId> next;
  const auto look_at = [&](NodeId node) {
    if (!nodes[at(node)].any && nodes[at(node)].open == 1) next.push_back(node);
  };
  const auto settle = [&](std::size_t force, NodeId by) {
    order_.push_back({force, by});
    found[force] = 1;
    for (const NodeId node : {forces_[force].a, forces_[force].b}) {
      --nodes[at(node)].open;
      look_at(node);
    }
  };
  const auto follow = [&] {
    while (!next.empty()) {
      const NodeId node = next.back();
      next.pop_back();
      const std::vector<std::size_t>& there = nodes[at(node)].forces;
      const auto one = std::find_if(there.begin(), there.end(), [&](std::size_t k) { return !found[k]; });
      if (one != there.end()) settle(*one, node);
    }
  };
  for (std::size_t n = 0; n < nodes.size(); ++n) look_at(static_cast<NodeId>(n));
  follow();
  for (std::size_t k = 0; k < otherwise; ++k) {
    if (found[k]) continue;
    settle(k, -1);
    follow();
  }
}

void BalancedForces::begin() {
  std::fill(at_node_.begin(), at_node_.end(), 0.0);
  std::fill(noise_.begin(), noise_.end(), 0.0);
}

}  // namespace rheonet
