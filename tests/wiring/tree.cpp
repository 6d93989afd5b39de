#include "tests/wiring/tree.hpp"

#include <algorithm>

namespace rheonet::test {

namespace {

int count_leaves(const Tree& tree) {
  if (tree.kind == Tree::Kind::leaf) return 1;
  int sum = 0;
  for (const Tree& member : tree.members) sum += count_leaves(member);
  return sum;
}

void wire(const Tree& tree, int a, int b, Graph& graph) {
  if (tree.kind == Tree::Kind::leaf) {
    graph.branches[static_cast<std::size_t>(tree.leaf)] = {a, b};
    return;
  }
  const bool series = tree.kind == Tree::Kind::series;
  int from = a;
  for (std::size_t k = 0; k < tree.members.size(); ++k) {
    const int to = !series || k + 1 == tree.members.size() ? b : graph.nodes++;
    wire(tree.members[k], from, to, graph);
    if (series) from = to;
  }
}

}  // namespace

Graph wired(const Tree& tree) {
  Graph graph;
  graph.branches.resize(static_cast<std::size_t>(count_leaves(tree)));
  wire(tree, 1, 0, graph);
  return graph;
}

Tree commuted(Tree tree) {
  std::reverse(tree.members.begin(), tree.members.end());
  for (Tree& member : tree.members) member = commuted(std::move(member));
  return tree;
}

std::string described(const Tree& tree, const std::vector<std::string>& leaves) {
  if (tree.kind == Tree::Kind::leaf) return leaves[static_cast<std::size_t>(tree.leaf)];
  std::string text = tree.kind == Tree::Kind::series ? "series(" : "parallel(";
  for (std::size_t k = 0; k < tree.members.size(); ++k) {
    text += (k > 0 ? ", " : "") + described(tree.members[k], leaves);
  }
  return text + ")";
}

}  // namespace rheonet::test
