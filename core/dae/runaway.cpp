#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <algorithm>
#include <cmath>

#include "core/dae/instant.hpp"
#include "core/network/index.hpp"
#include "core/network/overload.hpp"
#include "core/network/sets.hpp"

namespace rheonet {

namespace {

// A load within so much of what the elements can take is beyond it: friction comes to its bound in the limit only.
constexpr double nearly = 1e-6;
// What is left of a way that is full.
constexpr double flow_rounding = 1e-12;

/// Ways by which forces go through a network, from where loads push to what holds it. Nodes are numbered from 0.
class ForceFlow {
 public:
  explicit ForceFlow(std::size_t nodes) : graph_(nodes + 2), source_(nodes), sink_(nodes + 1) {}

  /// Takes up to `most` [N] either way.
  void link(std::size_t a, std::size_t b, double most) { add(a, b, most, most); }
  void push(std::size_t node, double force) { add(source_, node, force, 0); }
  void take(std::size_t node, double most) { add(node, sink_, most, 0); }

  /// The nodes from which not all that pushes comes away: of all such sets the one with the least left to hold it.
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
        if (reached[to] || !(boost::get(boost::edge_residual_capacity, graph_, *e) > flow_rounding * largest_)) continue;
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

/// The nodes that the loads push away to this side: those beyond the elements that bear the largest force they can take.
std::vector<char> Instant::pushed_away(int side) const {
  const std::size_t count = structure_.kind.size();
  std::vector<double> load(count, 0);
  double all = 0;
  for (std::size_t k = 0; k < network_.forces.size(); ++k) {
    const Network::Force& f = network_.forces[k];
    all += std::abs(drive_.force[k]);
    if (f.a >= 0) load[at(f.a)] += side * drive_.force[k];
    if (f.b >= 0) load[at(f.b)] -= side * drive_.force[k];
  }
  ForceFlow flow(count);
  const double any = 2 * all;
  const auto link = [&](const Branch& b, double most) {
    if (b.a != b.b) flow.link(at(b.a), at(b.b), std::min(most, any));
  };
  for (const Branch& b : network_.rates) link(b, any);
  for (const Laws<DeflectionBatch>& laws : network_.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const double bound = laws.batch->steady(i).bound;
      link(network_.deflections[at(laws.first) + i], std::isinf(bound) ? any : (1 - nearly) * bound);
    }
  }
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    link(network_.sliders[k].branch, (1 - nearly) * std::max(bound(k, 1), bound(k, -1)));
  }
  for (std::size_t n = 0; n < count; ++n) {
    if (!massless(static_cast<NodeId>(n))) {
      flow.take(n, any);
    } else if (load[n] > 0) {
      flow.push(n, load[n]);
    } else if (load[n] < 0) {
      flow.take(n, -load[n]);
    }
  }
  return flow.overloaded();
}

void Instant::report_runaway(double t, const std::vector<int>& runaways) const {
  std::vector<char> in = pushed_away(1);
  const std::vector<char> others = pushed_away(-1);
  for (std::size_t n = 0; n < in.size(); ++n) in[n] = in[n] || others[n];
  if (std::find(in.begin(), in.end(), 1) == in.end()) {
    for (const int k : runaways) in[at(network_.node_order[at(k)])] = 1;
  }
  std::vector<NodeId> nodes;
  for (std::size_t n = 0; n < in.size(); ++n) {
    if (in[n]) nodes.push_back(static_cast<NodeId>(n));
  }
  std::vector<int> elements;
  const auto mention = [&](const Branch& b) {
    if (in[at(b.a)] != in[at(b.b)]) elements.push_back(b.element);
  };
  for (const Network::Slider& s : network_.sliders) mention(s.branch);
  for (const Branch& b : network_.deflections) mention(b);
  report_overload(network_, t, nodes, elements);
}

}  // namespace rheonet
