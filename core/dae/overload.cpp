#include "core/dae/overload.hpp"

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

struct Bounded { Branch branch; double bound; };

/// Force that pushes each node, from loads and delayed laws [N].
std::vector<double> pushes(const EventNetwork& net, const State& state) {
  std::vector<double> push(net.structure.kind.size(), 0);
  const auto add = [&](NodeId node, double f) {
    if (node >= 0) push[at(node)] += f;
  };
  for (std::size_t k = 0; k < net.network.forces.size(); ++k) {
    add(net.network.forces[k].a, net.inputs.force[k]);
    add(net.network.forces[k].b, -net.inputs.force[k]);
  }
  std::vector<double> f(state.p.size()), creep(f);
  for (const Laws<DeflectionBatch>& laws : net.network.deflection_laws) {
    laws.batch->evaluate(&state.p[at(laws.first)], &f[at(laws.first)], &creep[at(laws.first)]);
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t j = at(laws.first) + i;
      if (!(laws.batch->delay(i) > 0)) continue;
      add(net.network.deflections[j].a, -f[j]);
      add(net.network.deflections[j].b, f[j]);
    }
  }
  return push;
}

/// Elements that can hold a node at an event, and the largest force that each can take [N].
std::vector<Bounded> bounded_elements(const EventNetwork& net, const SliderBounds& bounds) {
  std::vector<Bounded> result;
  for (std::size_t k = 0; k < net.network.sliders.size(); ++k) {
    result.push_back({net.network.sliders[k].branch, std::max(bounds.bound(k, 1), bounds.bound(k, -1))});
  }
  for (const Laws<DeflectionBatch>& laws : net.network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (laws.batch->delay(i) > 0 || net.network.is_gauge(laws.first + static_cast<int>(i))) continue;
      result.push_back({net.network.deflections[at(laws.first) + i], laws.batch->steady(i).bound});
    }
  }
  for (const Branch& b : net.network.rates) result.push_back({b, std::numeric_limits<double>::infinity()});
  return result;
}

/// The nodes that are pushed away to one side: the source side of the minimum cut, if elements can take their largest force
/// less a share of it.
std::vector<char> pushed_away(const EventNetwork& net, const std::vector<Bounded>& bounded, const std::vector<double>& push, int side, double share) {
  double any = 0;
  for (const double f : push) any += 2 * std::abs(f);
  ForceFlow flow(push.size());
  for (const Bounded& b : bounded) {
    if (b.branch.a != b.branch.b) flow.link(at(b.branch.a), at(b.branch.b), std::min((1 - share) * b.bound, any));
  }
  for (std::size_t n = 0; n < push.size(); ++n) {
    if (!net.massless(static_cast<NodeId>(n))) {
      flow.take(n, any);
    } else if (side * push[n] > 0) {
      flow.push(n, side * push[n]);
    } else {
      flow.take(n, -side * push[n]);
    }
  }
  return flow.overloaded();
}

/// An element without a largest force takes its other end along, or is held by it: there only round-off makes a node run away.
std::vector<char> carried(const EventNetwork& net, const std::vector<Bounded>& bounded, const std::vector<int>& runaways) {
  const std::size_t count = net.structure.kind.size();
  DisjointSets together(count);
  for (const Bounded& b : bounded) {
    if (std::isinf(b.bound)) together.join(b.branch.a, b.branch.b);
  }
  std::vector<char> held(count, 0), goes(count, 0), all(count, 0);  // the first two of each set, at the node that represents it
  for (NodeId n = 0; at(n) < count; ++n) {
    if (!net.massless(n)) held[at(together.find(n))] = 1;
  }
  for (const int k : runaways) goes[at(together.find(net.network.node_order[at(k)]))] = 1;
  for (NodeId n = 0; at(n) < count; ++n) all[at(n)] = goes[at(together.find(n))] && !held[at(together.find(n))];
  if (std::find(all.begin(), all.end(), 1) == all.end()) {
    for (const int k : runaways) all[at(net.network.node_order[at(k)])] = 1;
  }
  return all;
}

}  // namespace

void report_runaway(const EventNetwork& net, const SliderBounds& bounds, double t, const std::vector<int>& runaways, const State& state) {
  const std::vector<double> push = pushes(net, state);
  const std::vector<Bounded> bounded = bounded_elements(net, bounds);
  std::array<std::vector<char>, 2> sides;
  const auto found = [](const std::vector<char>& set) { return std::find(set.begin(), set.end(), 1) != set.end(); };
  for (std::size_t k = 0; k < numerics::overload_margins.size() && !found(sides[0]) && !found(sides[1]); ++k) {
    sides = {pushed_away(net, bounded, push, 1, numerics::overload_margins[k]), pushed_away(net, bounded, push, -1, numerics::overload_margins[k])};
  }
  if (!found(sides[0]) && !found(sides[1])) sides[0] = carried(net, bounded, runaways);
  const auto leaves = [](const std::vector<char>& set, const Branch& b) { return set[at(b.a)] != set[at(b.b)]; };
  std::vector<NodeId> nodes;
  for (std::size_t n = 0; n < push.size(); ++n) {
    if (sides[0][n] || sides[1][n]) nodes.push_back(static_cast<NodeId>(n));
  }
  std::vector<int> elements;
  for (const Bounded& b : bounded) {
    if (std::isinf(b.bound)) continue;
    if (leaves(sides[0], b.branch) || leaves(sides[1], b.branch)) elements.push_back(b.branch.element);
  }
  report_overload(net.network, t, nodes, elements);
}

}  // namespace rheonet
