#include "core/network/structure.hpp"

#include <fmt/format.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <numeric>
#include <utility>

#include "core/base/index.hpp"
#include "core/network/forest.hpp"
#include "core/network/reductions.hpp"
#include "core/network/rigid_links.hpp"
#include "core/network/trains.hpp"

namespace rheonet {

std::vector<char> firm_nodes(const Network& network, const Structure& structure) {
  std::vector<char> marked;
  for (const Kind kind : structure.kind) marked.push_back(kind == Kind::known || kind == Kind::massive);
  const std::vector<NodeId> held = linked_to(network, marked);
  for (std::size_t n = 0; n < marked.size(); ++n) marked[n] = held[n] >= 0;
  return marked;
}

namespace {

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
/// Joins the ends of sticking sliders. The representative is a known node if there is one, otherwise a massive one.
void join(const Network& network, const Modes& modes, Structure& s) {
  const std::size_t n = s.kind.size();
  Graph stuck_pairs(n);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Branch& b = network.sliders[k].branch;
    if (modes.slider[k] == Modes::stuck) boost::add_edge(at(b.a), at(b.b), stuck_pairs);
  }
  std::vector<int> part(n);
  const int parts = boost::connected_components(stuck_pairs, part.data());
  std::vector<NodeId> head(at(parts), -1);
  for (const Kind kind : {Kind::known, Kind::massive, Kind::floating}) {
    for (NodeId node : network.node_order) {
      if (s.kind[at(node)] == kind && head[at(part[at(node)])] < 0) head[at(part[at(node)])] = node;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const NodeId leader = head[at(part[i])];
    if (s.kind[i] == Kind::known || leader == static_cast<NodeId>(i)) continue;
    s.rigid[i] = leader;
    s.kind[i] = Kind::joined;
    if (s.kind[at(leader)] != Kind::known) s.mass[at(leader)] += s.mass[i];
    s.mass[i] = 0;
  }
  const auto end = [&](NodeId node) { return s.rigid[at(node)]; };
  for (Branch& b : s.deflections) b = {b.element, end(b.a), end(b.b)};
  for (Branch& b : s.rates) b = {b.element, end(b.a), end(b.b)};
  for (Branch& b : s.inerters) b = {b.element, end(b.a), end(b.b)};
  for (std::size_t k = 0; k < s.sliders.size(); ++k) {
    Branch& b = s.sliders[k];
    b = {b.element, end(b.a), end(b.b)};
    // A slider whose ends others join sticks too, even with its force at its bound.
    s.stuck[k] = s.stuck[k] || b.a == b.b;
  }
}

void assign_known_and_massive(const Network& network, Structure& s) {
  s.kind[ground] = Kind::known;
  s.of_time[ground] = 1;
  for (const Network::Mass& m : network.masses) {
    if (m.node == ground) continue;
    s.mass[at(m.node)] += m.mass;
    s.kind[at(m.node)] = Kind::massive;
  }
  const auto name = [&](int i) { return network.scene->elements[at(network.motions[at(i)].element)].name; };
  for (std::size_t i = 0; i < network.motions.size(); ++i) {
    const NodeId node = network.motions[i].node;
    if (node == ground) {
      throw SimulationError(network.spot_of(network.motions[i].element),
                            fmt::format("motion `{}` moves `ground`, which never moves; prescribe another node",
                                        name(static_cast<int>(i))));
    }
    if (s.motion[at(node)] >= 0) {
      throw SimulationError(network.spot_of(network.motions[i].element),
                            fmt::format("motions `{}` and `{}` both prescribe node `{}`; leave one out",
                                        name(s.motion[at(node)]), name(static_cast<int>(i)), network.node_name(node)));
    }
    s.motion[at(node)] = static_cast<int>(i);
    s.kind[at(node)] = Kind::known;
    s.of_time[at(node)] = network.motions[i].block < 0;
  }
}

/// Massless nodes that inerters join to a mass or to a known node have a momentum too. Throws SimulationError where inerters join
/// massless nodes alone: their common velocity follows from no equation.
void assign_inertia(const Network& network, Structure& s) {
  s.inertia = s.mass;
  if (s.inerters.empty()) return;
  const auto firm = [&](NodeId node) { return s.kind[at(node)] == Kind::known || s.kind[at(node)] == Kind::massive; };
  // Rigid links hold a node as inerters do.
  const std::vector<char> held = firm_nodes(network, s);
  for (const Branch& b : s.inerters) {
    for (const NodeId node : {b.a, b.b}) {
      if (!firm(node) && held[at(node)]) s.kind[at(node)] = Kind::massive;
    }
  }
  for (bool again = true; std::exchange(again, false);) {
    for (const Branch& b : s.inerters) {
      if (b.a == b.b || firm(b.a) == firm(b.b)) continue;
      s.kind[at(firm(b.a) ? b.b : b.a)] = Kind::massive;
      again = true;
    }
  }
  for (std::size_t k = 0; k < s.inerters.size(); ++k) {
    const Branch& b = s.inerters[k];
    if (b.a == b.b) continue;
    if (!firm(b.a)) {
      throw SimulationError(network.spot_of(b.element),
                            fmt::format("inerter `{}` and those joined to it end at nodes without a mass alone, whose common velocity nothing "
                                        "determines; give node `{}` or `{}` a mass",
                                        network.name_of(b), network.node_name(b.a), network.node_name(b.b)));
    }
    for (const NodeId node : {b.a, b.b}) s.inertia[at(node)] += network.inerters[k].inertance;
  }
}

/// Massless nodes that dashpots join are viscous if dashpots lead to a known or massive node, otherwise one floating group.
void assign_viscous_and_floating(const Network& network, Structure& s) {
  // The search ends at known and massive nodes, which are therefore not in the graph.
  const std::size_t n = s.kind.size();
  const auto massless = [&](NodeId node) { return s.kind[at(node)] == Kind::floating; };
  Graph dashpots(n);
  std::vector<char> anchored(n, 0);
  for (const Branch& b : s.rates) {
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

Structure blank_structure(const Network& network) {
  const std::size_t n = network.nodes();
  Structure s;
  s.kind.assign(n, Kind::floating);
  s.motion.assign(n, -1);
  s.of_time.assign(n, 0);
  s.group.assign(n, -1);
  s.mass.assign(n, 0);
  s.rank.resize(n);
  s.rigid.resize(n);
  std::iota(s.rigid.begin(), s.rigid.end(), 0);
  s.deflections = network.deflections;
  s.rates = network.rates;
  for (const Network::Slider& slider : network.sliders) s.sliders.push_back(slider.branch);
  for (const Network::Inerter& inerter : network.inerters) s.inerters.push_back(inerter.branch);
  s.stuck.assign(network.sliders.size(), 0);
  for (std::size_t k = 0; k < n; ++k) s.rank[at(network.node_order[k])] = static_cast<int>(k);
  assign_known_and_massive(network, s);
  s.own_mass = s.mass;
  return s;
}

}  // namespace

Structure::Loop minus_velocity(const Structure& structure, NodeId node, NodeId against) {
  return express(structure, structure.rigid[at(node)], structure.rigid[at(against)], -1);
}

Structure::Loop closed_loop(const Network& network, const Structure& structure, int branch) {
  std::size_t i = 0;
  if (network.batch_of(branch, i).delay(i) > 0) return {.branch = branch, .flows = {{branch, 1}}, .velocities = {}};
  const Branch& b = structure.deflections[at(branch)];
  return express(structure, b.a, b.b, branch);
}

Structure classify(const Network& network) {
  Structure s = blank_structure(network);
  assign_inertia(network, s);
  assign_trains(network, s, nullptr);
  assign_viscous_and_floating(network, s);
  return s;
}

Structure analyse(const Network& network, const Modes& modes) {
  Structure s = blank_structure(network);
  for (std::size_t k = 0; k < s.stuck.size(); ++k) s.stuck[k] = modes.slider[k] == Modes::stuck;
  join(network, modes, s);
  assign_inertia(network, s);
  assign_trains(network, s, &modes);
  assign_viscous_and_floating(network, s);
  grow_forest(network, s);

  s.driven.assign(network.deflections.size(), 0);
  const bool integrate_given = kept(*network.scene, Reduction::given);
  std::vector<char> in_tree(network.deflections.size(), 0);
  for (const Structure::Group& g : s.groups) {
    if (g.tree_branch >= 0) in_tree[at(g.tree_branch)] = 1;
  }
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const int j = laws.first + static_cast<int>(i);
      const Branch& b = s.deflections[at(j)];
      const bool given = b.a == b.b || (!integrate_given && s.of_time[at(b.a)] && s.of_time[at(b.b)]);
      s.driven[at(j)] = given && !laws.batch->creeps(i);
      if (laws.batch->delay(i) > 0 || (!s.driven[at(j)] && !in_tree[at(j)])) s.closing.push_back(j);
    }
  }
  return s;
}

}  // namespace rheonet
