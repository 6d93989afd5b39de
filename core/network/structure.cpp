#include "core/network/structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <map>
#include <queue>

namespace rheonet {

namespace {

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
std::size_t at(int i) { return static_cast<std::size_t>(i); }

void assign_known_and_massive(const Network& network, Structure& s) {
  s.kind[ground] = Kind::known;
  for (const Network::Mass& m : network.masses) {
    if (m.node == ground) continue;
    s.mass[at(m.node)] += m.mass;
    s.kind[at(m.node)] = Kind::massive;
  }
  const auto name = [&](int i) { return network.scene->elements[at(network.motions[at(i)].element)].name; };
  for (std::size_t i = 0; i < network.motions.size(); ++i) {
    const NodeId node = network.motions[i].node;
    if (node == ground) {
      throw SimulationError(fmt::format("motion `{}` moves `ground`, which never moves; prescribe another node",
                                        name(static_cast<int>(i))));
    }
    if (s.motion[at(node)] >= 0) {
      throw SimulationError(fmt::format("motions `{}` and `{}` both prescribe node `{}`; leave one out",
                                        name(s.motion[at(node)]), name(static_cast<int>(i)), network.node_name(node)));
    }
    s.motion[at(node)] = static_cast<int>(i);
    s.kind[at(node)] = Kind::known;
  }
}

/// Massless nodes joined by dashpots: viscous if the dashpots lead to a known or massive node, else one floating group.
void assign_viscous_and_floating(const Network& network, Structure& s) {
  // Known and massive nodes stop the search: dashpots beyond them are another matter. They are left out of the graph.
  const std::size_t n = s.kind.size();
  const auto massless = [&](NodeId node) { return s.kind[at(node)] == Kind::floating; };
  Graph dashpots(n);
  std::vector<char> anchored(n, 0);
  for (const Branch& b : network.rates) {
    if (massless(b.a) && massless(b.b)) boost::add_edge(at(b.a), at(b.b), dashpots);
    if (massless(b.a) && !massless(b.b)) anchored[at(b.a)] = 1;
    if (massless(b.b) && !massless(b.a)) anchored[at(b.b)] = 1;
  }
  std::vector<int> part(n);
  const int parts = boost::connected_components(dashpots, part.data());
  std::vector<char> viscous(at(parts), 0);
  for (std::size_t i = 0; i < n; ++i) {
    if (anchored[i]) viscous[at(part[i])] = 1;
  }
  std::vector<int> group_of_part(at(parts), -1);
  for (NodeId node : network.node_order) {
    const std::size_t i = at(node);
    if (!massless(node)) continue;
    if (viscous[at(part[i])]) {
      s.kind[i] = Kind::viscous;
      continue;
    }
    int& group = group_of_part[at(part[i])];
    if (group < 0) {
      group = static_cast<int>(s.groups.size());
      s.groups.emplace_back();
    }
    s.groups[at(group)].nodes.push_back(node);
    s.group[i] = group;
  }
}

[[noreturn]] void report_undefined(const Network& network, const Structure& s, const std::vector<char>& reached) {
  std::string names;
  int count = 0;
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    if (reached[g]) continue;
    for (NodeId node : s.groups[g].nodes) {
      if (++count <= 5) names += fmt::format("{}`{}`", names.empty() ? "" : ", ", network.node_name(node));
    }
  }
  if (count > 5) names += fmt::format(" and {} more", count - 5);
  throw SimulationError(fmt::format(
      "nothing determines the motion of node{} {}: no mass there, and no element that resists motion leads from there to "
      "ground, to a mass or to a prescribed motion; add one, or a mass",
      count > 1 ? "s" : "", names));
}

/// Breadth first, so that loops stay short. Groups are renumbered by depth.
void grow_tree(const Network& network, Structure& s) {
  const std::size_t n = s.groups.size();
  std::vector<std::vector<int>> branches_of(n);
  std::queue<int> queue;
  std::vector<char> reached(n, 0);
  const auto attach = [&](int branch, NodeId node, NodeId parent, int depth) {
    const int g = s.group[at(node)];
    if (reached[at(g)]) return;
    reached[at(g)] = 1;
    Structure::Group& group = s.groups[at(g)];
    group.tree_branch = branch;
    group.node = node;
    group.parent = parent;
    group.sign = network.deflections[at(branch)].a == node ? 1 : -1;
    group.depth = depth;
    queue.push(g);
  };
  for (std::size_t j = 0; j < network.deflections.size(); ++j) {
    const Branch& b = network.deflections[j];
    const int ga = s.group[at(b.a)], gb = s.group[at(b.b)];
    if (ga >= 0) branches_of[at(ga)].push_back(static_cast<int>(j));
    if (gb >= 0 && gb != ga) branches_of[at(gb)].push_back(static_cast<int>(j));
    if (ga >= 0 && gb < 0) attach(static_cast<int>(j), b.a, b.b, 1);
    if (gb >= 0 && ga < 0) attach(static_cast<int>(j), b.b, b.a, 1);
  }
  std::vector<int> order;
  while (!queue.empty()) {
    const int g = queue.front();
    queue.pop();
    order.push_back(g);
    for (int j : branches_of[at(g)]) {
      const Branch& b = network.deflections[at(j)];
      if (s.group[at(b.a)] == g && s.group[at(b.b)] >= 0) attach(j, b.b, b.a, s.groups[at(g)].depth + 1);
      if (s.group[at(b.b)] == g && s.group[at(b.a)] >= 0) attach(j, b.a, b.b, s.groups[at(g)].depth + 1);
    }
  }
  if (order.size() < n) report_undefined(network, s, reached);
  std::vector<Structure::Group> sorted;
  sorted.reserve(n);
  for (int g : order) {
    for (NodeId node : s.groups[at(g)].nodes) s.group[at(node)] = static_cast<int>(sorted.size());
    sorted.push_back(std::move(s.groups[at(g)]));
  }
  s.groups = std::move(sorted);
}

/// -(v_a - v_b), expressed along the tree from both nodes up to where their paths meet, plus the flow of `branch` if any.
Structure::Loop express(const Structure& s, NodeId a, NodeId b, int branch) {
  std::map<int, double> flows, velocities;
  if (branch >= 0) flows[branch] = 1;
  // velocity(node) = v_node + base(group), base(group) = base(parent's group) + v_parent - v_node' + sign (p' + creep)
  const auto add_velocity = [&](NodeId node, double sign) { velocities[node] -= sign; };
  const auto climb = [&](int group, double sign) {
    const Structure::Group& g = s.groups[at(group)];
    add_velocity(g.parent, sign);
    add_velocity(g.node, -sign);
    flows[g.tree_branch] -= sign * g.sign;
    return s.group[at(g.parent)];
  };
  add_velocity(a, 1);
  add_velocity(b, -1);
  int ga = s.group[at(a)], gb = s.group[at(b)];
  while (ga != gb) {
    const int da = ga < 0 ? 0 : s.groups[at(ga)].depth, db = gb < 0 ? 0 : s.groups[at(gb)].depth;
    if (da >= db) {
      ga = climb(ga, 1);
    } else {
      gb = climb(gb, -1);
    }
  }
  Structure::Loop loop{.branch = branch, .flows = {}, .velocities = {}};
  for (auto [j, sign] : flows) {
    if (sign != 0) loop.flows.push_back({j, sign});
  }
  for (auto [node, sign] : velocities) {
    if (sign != 0 && node != ground) loop.velocities.push_back({node, sign});
  }
  std::sort(loop.velocities.begin(), loop.velocities.end(), [&](const Structure::Term& x, const Structure::Term& y) {
    return s.rank[at(x.index)] < s.rank[at(y.index)];
  });
  return loop;
}

}  // namespace

Structure::Loop minus_velocity(const Structure& structure, NodeId node) {
  return express(structure, node, ground, -1);
}

Structure analyse(const Network& network) {
  const std::size_t n = network.scene->nodes.size();
  Structure s;
  s.kind.assign(n, Kind::floating);
  s.motion.assign(n, -1);
  s.group.assign(n, -1);
  s.mass.assign(n, 0);
  s.rank.resize(n);
  for (std::size_t k = 0; k < n; ++k) s.rank[at(network.node_order[k])] = static_cast<int>(k);
  assign_known_and_massive(network, s);
  assign_viscous_and_floating(network, s);
  grow_tree(network, s);

  s.driven.assign(network.deflections.size(), 0);
  std::vector<char> in_tree(network.deflections.size(), 0);
  for (const Structure::Group& g : s.groups) in_tree[at(g.tree_branch)] = 1;
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const int j = laws.first + static_cast<int>(i);
      const Branch& b = network.deflections[at(j)];
      s.driven[at(j)] = s.kind[at(b.a)] == Kind::known && s.kind[at(b.b)] == Kind::known && !laws.batch->creeps(i);
      if (!s.driven[at(j)] && !in_tree[at(j)]) s.loops.push_back(express(s, b.a, b.b, j));
    }
  }
  return s;
}

}  // namespace rheonet
