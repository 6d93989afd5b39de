#include "tests/wiring/random_wiring.hpp"

#include <algorithm>
#include <utility>

namespace rheonet::test {

namespace {

using Branch = Graph::Branch;

// One split of the leaves into two or three members; those of more than one leaf are groups of the other kind.
Tree grown(Random& random, int& next, int leaves, bool series) {
  if (leaves == 1) return Tree::of_leaf(next++);
  const int members = std::min(leaves, 2 + random.below(2));
  std::vector<int> sizes(static_cast<std::size_t>(members), 1);
  for (int k = members; k < leaves; ++k) ++sizes[static_cast<std::size_t>(random.below(members))];
  std::vector<Tree> trees;
  for (const int size : sizes) trees.push_back(grown(random, next, size, !series));
  return series ? Tree::series(std::move(trees)) : Tree::parallel(std::move(trees));
}

bool joins(const Branch& b, int i, int j) { return (b.a == i && b.b == j) || (b.a == j && b.b == i); }

/// True if merging parallel branches and those in series at an inner node leaves one branch (Duffin 1965).
bool series_parallel(Graph graph) {
  std::vector<Branch>& branches = graph.branches;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < branches.size(); ++i) {
      const auto twin = std::find_if(branches.begin() + std::ptrdiff_t(i) + 1, branches.end(),
                                     [&](const Branch& b) { return joins(b, branches[i].a, branches[i].b); });
      if (twin == branches.end()) continue;
      branches.erase(twin);
      changed = true;
    }
    for (int node = 2; node < graph.nodes; ++node) {
      std::vector<std::size_t> there;
      for (std::size_t i = 0; i < branches.size(); ++i) {
        if (branches[i].a == node || branches[i].b == node) there.push_back(i);
      }
      if (there.size() != 2) continue;
      const auto other = [&](const Branch& b) { return b.a == node ? b.b : b.a; };
      branches[there[0]] = {other(branches[there[0]]), other(branches[there[1]])};
      branches.erase(branches.begin() + std::ptrdiff_t(there[1]));
      changed = true;
      break;  // The new branch may be parallel to another, and parallel branches are merged first.
    }
  }
  return branches.size() == 1;
}

/// True if every branch lies on a path without loops from node 1 to node 0. It does if, with a branch added between the
/// two, no single node separates the graph: without any one node the rest hangs together.
bool all_on_paths(const Graph& graph) {
  for (int without = -1; without < graph.nodes; ++without) {
    std::vector<int> part(static_cast<std::size_t>(graph.nodes));
    for (int n = 0; n < graph.nodes; ++n) part[static_cast<std::size_t>(n)] = n;
    const auto join = [&](int i, int j) {
      if (i == without || j == without) return;
      const int from = part[static_cast<std::size_t>(i)], to = part[static_cast<std::size_t>(j)];
      std::replace(part.begin(), part.end(), from, to);
    };
    for (const Branch& b : graph.branches) join(b.a, b.b);
    join(0, 1);
    const int first = part[without == 0 ? 1 : 0];
    for (int n = 0; n < graph.nodes; ++n) {
      if (n != without && part[static_cast<std::size_t>(n)] != first) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::string> random_types(Random& random, std::size_t count) {
  std::vector<std::string> types;
  for (std::size_t k = 0; k < count; ++k) types.emplace_back(law_types[static_cast<std::size_t>(random.below(6))]);
  return types;
}

Tree random_tree(Random& random, int leaves) {
  int next = 0;
  return grown(random, next, leaves, random.below(2) == 0);
}

Graph random_graph(Random& random) {
  for (;;) {
    Graph graph;
    graph.nodes = 4 + random.below(3);
    const int branches = graph.nodes + 1 + random.below(4);
    for (int k = 0; k < branches; ++k) {
      const int a = random.below(graph.nodes), b = random.below(graph.nodes - 1);
      graph.branches.push_back({a, b < a ? b : b + 1});
    }
    if (all_on_paths(graph) && !series_parallel(graph)) return graph;
  }
}

std::string described(const Graph& graph, const std::vector<std::string>& types) {
  std::string text;
  for (std::size_t k = 0; k < types.size(); ++k) {
    text += (k > 0 ? ", " : "") + types[k] + " " + node_name(graph.branches[k].a) + "-" + node_name(graph.branches[k].b);
  }
  return text;
}

std::string node_name(int node) {
  return node == 0 ? "ground" : node == 1 ? "end" : "n" + std::to_string(node - 1);
}

}  // namespace rheonet::test
