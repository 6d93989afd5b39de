#include "core/network/free_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/netlist/diagnostic_list.hpp"
#include "core/network/component.hpp"
#include "core/network/network.hpp"

namespace rheonet {

namespace {

Role role_of(const Reduced& law) { return law.component ? law.component->role : Role::nothing; }

bool joins_ends(Role role) { return role == Role::deflection || role == Role::rate || role == Role::slip || role == Role::inerter; }

bool is_given(double start) { return !std::isnan(start) && start != 0; }

bool has_initial_value(const SceneElement& e) {
  const std::vector<Parameter>& parameters = components()[at(e.declaration)]->declaration.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].kind == Parameter::Kind::initial && is_given(e.values[k])) return true;
  }
  return false;
}

class FreeEndSearch {
 public:
  FreeEndSearch(const Scene& scene, const std::vector<Reduced>& laws)
      : scene_(scene), laws_(laws), result_{std::vector<NodeId>(scene.nodes.size()), {}}, held_(scene.nodes.size(), 0) {
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) result_.on[n] = static_cast<NodeId>(n);
  }

  FreeEnds find() {
    find_held();
    if (all_held_or_between_held()) return std::move(result_);
    find_hanging();
    if (any_hangs()) let_stressed_go();
    for (std::size_t e = 0; e < laws_.size(); ++e) {
      const SceneElement& element = scene_.elements[e];
      if (joins_ends(role_of(laws_[e])) && result_.on[at(element.a)] == result_.on[at(element.b)])
        result_.elements.push_back(static_cast<int>(e));
    }
    return std::move(result_);
  }

 private:
  bool any_hangs() const {
    for (std::size_t n = 0; n < result_.on.size(); ++n) {
      if (result_.on[n] != static_cast<NodeId>(n)) return true;
    }
    return false;
  }

  /// Nodes held otherwise than by elements that join nodes: by a mass, a motion, a force, a transmission or a start value.
  void find_held() {
    held_[ground] = 1;
    for (std::size_t n = 0; n < held_.size(); ++n) {
      const SceneNode& node = scene_.nodes[n];
      if (is_given(node.position) || !std::isnan(node.velocity)) held_[n] = 1;
    }
    for (std::size_t e = 0; e < laws_.size(); ++e) {
      const Role role = role_of(laws_[e]);
      if (role != Role::mass && role != Role::motion && role != Role::force && role != Role::train) continue;
      for_each_node(scene_.elements[e], [this](NodeId node) { held_[at(node)] = 1; });
    }
  }

  /// The common case, without a graph: a node that joins two different held nodes does not hang.
  bool all_held_or_between_held() const {
    constexpr NodeId none = -1, several = -2;
    std::vector<NodeId> neighbour(held_.size(), none);
    const auto meet = [&](NodeId node, NodeId other) {
      if (!held_[at(other)]) return;
      NodeId& met = neighbour[at(node)];
      met = met == none || met == other ? other : several;
    };
    for (std::size_t e = 0; e < laws_.size(); ++e) {
      if (!joins_ends(role_of(laws_[e]))) continue;
      meet(scene_.elements[e].a, scene_.elements[e].b);
      meet(scene_.elements[e].b, scene_.elements[e].a);
    }
    for (std::size_t n = 0; n < held_.size(); ++n) {
      if (!held_[n] && neighbour[n] != several) return false;
    }
    return true;
  }

  /// Hanging nodes share no biconnected component with the auxiliary node `above`, which is joined to every held node.
  void find_hanging() {
    using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                        boost::property<boost::edge_index_t, std::size_t>>;
    const std::size_t nodes = held_.size(), above = nodes;
    // Keep one edge per pair of nodes: Boost's biconnected_components does not number edges parallel to the tree edge.
    std::vector<std::pair<std::size_t, std::size_t>> joins;
    for (std::size_t e = 0; e < laws_.size(); ++e) {
      const std::size_t a = at(scene_.elements[e].a), b = at(scene_.elements[e].b);
      if (joins_ends(role_of(laws_[e])) && !(held_[a] && held_[b])) joins.push_back(std::minmax(a, b));
    }
    std::sort(joins.begin(), joins.end());
    joins.erase(std::unique(joins.begin(), joins.end()), joins.end());
    for (std::size_t n = 0; n < nodes; ++n) {
      if (held_[n]) joins.push_back({n, above});
    }
    Graph graph(nodes + 1);
    for (std::size_t k = 0; k < joins.size(); ++k) boost::add_edge(joins[k].first, joins[k].second, k, graph);
    std::vector<std::size_t> block(joins.size());
    const auto index = boost::get(boost::edge_index, graph);
    const std::size_t blocks = boost::biconnected_components(graph, boost::make_iterator_property_map(block.begin(), index));
    std::vector<char> firm(blocks, 0);
    for (const auto& edge : boost::make_iterator_range(boost::out_edges(above, graph))) firm[block[boost::get(index, edge)]] = 1;
    std::vector<std::size_t> reached;  // nodes that do not hang, then hanging nodes in the order of the search
    std::vector<char> met(nodes + 1, 0);
    met[above] = 1;
    for (std::size_t n = 0; n < nodes; ++n) {
      const auto around = boost::make_iterator_range(boost::out_edges(n, graph));
      met[n] = std::any_of(around.begin(), around.end(), [&](const auto& edge) { return firm[block[boost::get(index, edge)]] != 0; });
      if (met[n]) reached.push_back(n);
    }
    for (std::size_t k = 0; k < reached.size(); ++k) {
      for (const auto& edge : boost::make_iterator_range(boost::out_edges(reached[k], graph))) {
        const std::size_t other = boost::target(edge, graph);
        if (met[other]) continue;
        met[other] = 1;
        result_.on[other] = result_.on[reached[k]];
        reached.push_back(other);
      }
    }
  }

  /// A spring is stressed at the start if its ends are not at its rest length; a step at the start may stress it too.
  bool stressed(std::size_t e) const {
    if (laws_[e].component->role != Role::deflection) return false;
    const auto batch = laws_[e].component->deflection(laws_[e].batch());
    const double p = batch->start(0, 0);
    double force = 0, creep = 0;
    batch->evaluate(&p, &force, &creep);
    return force != 0;
  }

  /// Removes a whole connected part from the free ends if anything in it may start at a displacement other than 0.
  void let_stressed_go() {
    DisjointSets together(held_.size());
    std::vector<std::size_t> displaced;
    for (std::size_t n = 0; n < held_.size(); ++n) {
      if (is_given(scene_.nodes[n].position)) displaced.push_back(n);
    }
    for (std::size_t e = 0; e < laws_.size(); ++e) {
      const SceneElement& element = scene_.elements[e];
      if (!element.at && element.a != ground && element.b != ground) together.join(element.a, element.b);
      const bool moved = laws_[e].component && laws_[e].component->role == Role::motion && prescribes(element, Quantity::position) &&
                         (fed(e) || element.signals.at(0).before(scene_.start) != 0);
      const bool hangs = joins_ends(role_of(laws_[e])) && result_.on[at(element.a)] == result_.on[at(element.b)];
      if (!moved && !has_initial_value(element) && !(hangs && stressed(e))) continue;
      displaced.push_back(at(element.a));
      displaced.push_back(at(element.b));
    }
    std::vector<char> goes(held_.size(), 0);
    for (const std::size_t n : displaced) goes[at(together.find(static_cast<NodeId>(n)))] = 1;
    goes[ground] = 0;  // ground connects nothing
    for (std::size_t n = 1; n < held_.size(); ++n) {
      if (goes[at(together.find(static_cast<NodeId>(n)))]) result_.on[n] = static_cast<NodeId>(n);
    }
  }

  /// The motion follows a block, so that its node starts at the block's initial output.
  bool fed(std::size_t e) const {
    return std::any_of(scene_.feeds.begin(), scene_.feeds.end(), [&](const SceneFeed& feed) { return feed.element == static_cast<int>(e); });
  }

  const Scene& scene_;
  const std::vector<Reduced>& laws_;
  FreeEnds result_;
  std::vector<char> held_;
};

/// Names of the nodes that no element joins to another.
std::vector<std::string> lone_nodes(const Scene& scene) {
  std::vector<char> lone(scene.nodes.size(), 1);
  for (const SceneElement& element : scene.elements) {
    if (!element.at) for_each_node(element, [&](NodeId node) { lone[at(node)] = 0; });
  }
  std::vector<std::string> names;
  for (std::size_t n = 1; n < lone.size(); ++n) {
    if (lone[n]) names.push_back(scene.nodes[n].name);
  }
  return names;
}

}  // namespace

FreeEnds find_free_ends(const Scene& scene, const std::vector<Reduced>& laws) { return FreeEndSearch(scene, laws).find(); }

std::vector<std::string> tell_free_ends(const Scene& scene, const FreeEnds& ends) {
  struct Hanging { std::vector<std::string> nodes, elements; };
  std::map<NodeId, Hanging> hanging;
  for (std::size_t n = 0; n < ends.on.size(); ++n) {
    if (ends.on[n] != static_cast<NodeId>(n)) hanging[ends.on[n]].nodes.push_back(scene.nodes[n].name);
  }
  for (const int e : ends.elements) hanging[ends.on[at(scene.elements[at(e)].a)]].elements.push_back(scene.elements[at(e)].name);
  const bool mistyped = !hanging.empty() && static_cast<std::ptrdiff_t>(hanging.size()) <= most_mistyped;
  const std::vector<std::string> lone = mistyped ? lone_nodes(scene) : std::vector<std::string>();
  std::vector<std::string> words;
  for (const auto& [node, what] : hanging) {
    if (what.elements.size() < 2) continue;
    const bool several = what.nodes.size() > 1;
    const std::string goes = node == ground ? (several ? "rest" : "rests") : (several ? "move with it" : "moves with it");
    words.push_back(fmt::format("node{} {} hang{} on `{}` alone and {}: {} carry no force", several ? "s" : "", format_list(what.nodes),
                                several ? "" : "s", scene.nodes[at(node)].name, goes, format_list(what.elements)));
    const std::string hint = several ? "" : did_you_mean(what.nodes.front(), lone);
    if (!hint.empty()) words.back() += "; " + hint;
  }
  return words;
}

}  // namespace rheonet
