#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/event_transition.hpp"
#include "core/network/overload_report.hpp"

namespace rheonet {

namespace {

/// Flow of forces through a network, from where loads push to where nodes are held. Nodes are numbered from 0.
class ForceFlow {
 public:
  explicit ForceFlow(std::size_t nodes) : graph_(nodes + 2), source_(nodes), sink_(nodes + 1) {}

  /// Takes up to `most` [N] either way.
  void link(std::size_t a, std::size_t b, double most) { add(a, b, most, most); }
  void push(std::size_t node, double force) { add(source_, node, force, 0); }
  void take(std::size_t node, double most) { add(node, sink_, most, 0); }

  /// The source side of a minimum cut: the nodes from which not all that pushes can flow away.
  std::vector<char> overloaded() {
    boost::boykov_kolmogorov_max_flow(graph_, source_, sink_);
    std::vector<char> reached(boost::num_vertices(graph_), 0);
    std::vector<std::size_t> open = {source_};
    reached[source_] = 1;
    while (!open.empty()) {
      const std::size_t from = open.back();
      open.pop_back();
      for (auto [e, end] = boost::out_edges(from, graph_); e != end; ++e) {
        const std::size_t to = boost::target(*e, graph_);
        if (reached[to] || !(boost::get(boost::edge_residual_capacity, graph_, *e) > numerics::balance_roundoff * largest_)) continue;
        reached[to] = 1;
        open.push_back(to);
      }
    }
    reached.resize(source_);
    return reached;
  }

 private:
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::bidirectionalS>;
  using Ways = boost::property<
      boost::edge_capacity_t, double,
      boost::property<boost::edge_residual_capacity_t, double, boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>;
  using Search = boost::property<
      boost::vertex_color_t, boost::default_color_type,
      boost::property<boost::vertex_distance_t, long, boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>;
  using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::bidirectionalS, Search, Ways>;

  void add(std::size_t from, std::size_t to, double there, double back) {
    const auto way = boost::add_edge(from, to, graph_).first, other = boost::add_edge(to, from, graph_).first;
    boost::put(boost::edge_capacity, graph_, way, there);
    boost::put(boost::edge_capacity, graph_, other, back);
    boost::put(boost::edge_reverse, graph_, way, other);
    boost::put(boost::edge_reverse, graph_, other, way);
    largest_ = std::max({largest_, there, back});
  }

  Graph graph_;
  std::size_t source_, sink_;
  double largest_ = 0;
};

}  // namespace

/// Force that pushes each node, from loads and delayed laws [N].
std::vector<double> EventTransition::pushes(const State& state) const {
  std::vector<double> push(structure_.kind.size(), 0);
  const auto add = [&](NodeId node, double f) {
    if (node >= 0) push[at(node)] += f;
  };
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    add(network_.forces[k].a, inputs_.force[k]);
    add(network_.forces[k].b, -inputs_.force[k]);
  }
  std::vector<double> f(state.p.size()), creep(f);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &creep[at(laws.first)]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      if (!(laws.batch->delay(i) > 0)) continue;
      add(network_.deflections[j].a, -f[j]);
      add(network_.deflections[j].b, f[j]);
    }
  }
  return push;
}

/// The nodes that are pushed away to one side: the source side of the minimum cut, if elements can take their largest force
/// less a share of it.
std::vector<char> EventTransition::pushed_away(const std::vector<double>& push, int side, double share) const {
  double any = 0;
  for (const double f : push) any += 2 * std::abs(f);
  ForceFlow flow(push.size());
  for (const Bounded& b : bounded()) {
    if (b.branch.a != b.branch.b) flow.link(at(b.branch.a), at(b.branch.b), std::min((1 - share) * b.bound, any));
  }
  for (std::size_t n = 0; n < push.size(); ++n) {
    if (!massless(static_cast<NodeId>(n))) {
      flow.take(n, any);
    } else if (side * push[n] > 0) {
      flow.push(n, side * push[n]);
    } else {
      flow.take(n, -side * push[n]);
    }
  }
  return flow.overloaded();
}

/// Elements that can hold a node at an event, and the largest force that each can take [N].
std::vector<EventTransition::Bounded> EventTransition::bounded() const {
  std::vector<Bounded> result;
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    result.push_back({network_.sliders[k].branch, std::max(bound(k, 1), bound(k, -1))});
  }
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->delay(i) > 0 || network_.is_gauge(laws.first + static_cast<int>(i))) continue;
      result.push_back({network_.deflections[at(laws.first) + i], laws.batch->steady(i).bound});
    }
  }
  for (const Branch& b : network_.rates) result.push_back({b, std::numeric_limits<double>::infinity()});
  return result;
}

/// An element without a largest force takes its other end along, or is held by it: there only round-off makes a node run away.
std::vector<char> EventTransition::carried(const std::vector<int>& runaways) const {
  const std::size_t count = structure_.kind.size();
  DisjointSets together(count);
  for (const Bounded& b : bounded()) {
    if (std::isinf(b.bound)) together.join(b.branch.a, b.branch.b);
  }
  std::vector<char> held(count, 0), goes(count, 0), all(count, 0);  // the first two of each set, at the node that represents it
  for (NodeId n = 0; at(n) < count; ++n) {
    if (!massless(n)) held[at(together.find(n))] = 1;
  }
  for (const int k : runaways) goes[at(together.find(network_.node_order[at(k)]))] = 1;
  for (NodeId n = 0; at(n) < count; ++n) all[at(n)] = goes[at(together.find(n))] && !held[at(together.find(n))];
  if (std::find(all.begin(), all.end(), 1) == all.end()) {
    for (const int k : runaways) all[at(network_.node_order[at(k)])] = 1;
  }
  return all;
}

void EventTransition::report_runaway(double t, const std::vector<int>& runaways, const State& state) const {
  const std::vector<double> push = pushes(state);
  std::array<std::vector<char>, 2> sides;
  const auto found = [](const std::vector<char>& set) { return std::find(set.begin(), set.end(), 1) != set.end(); };
  for (std::size_t k = 0; k < numerics::overload_margins.size() && !found(sides[0]) && !found(sides[1]); ++k) {
    sides = {pushed_away(push, 1, numerics::overload_margins[k]), pushed_away(push, -1, numerics::overload_margins[k])};
  }
  if (!found(sides[0]) && !found(sides[1])) sides[0] = carried(runaways);
  const auto leaves = [](const std::vector<char>& set, const Branch& b) { return set[at(b.a)] != set[at(b.b)]; };
  std::vector<NodeId> nodes;
  for (std::size_t n = 0; n < push.size(); ++n) {
    if (sides[0][n] || sides[1][n]) nodes.push_back(static_cast<NodeId>(n));
  }
  std::vector<int> elements;
  for (const Bounded& b : bounded()) {
    if (std::isinf(b.bound)) continue;
    if (leaves(sides[0], b.branch) || leaves(sides[1], b.branch)) elements.push_back(b.branch.element);
  }
  report_overload(network_, t, nodes, elements);
}

}  // namespace rheonet
