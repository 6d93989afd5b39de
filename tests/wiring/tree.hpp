#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rheonet::test {

/// A series-parallel arrangement of leaves, which are numbered from 0 in the order in which they are named.
struct Tree {
  enum class Kind { leaf, series, parallel };
  Kind kind = Kind::leaf;
  int leaf = 0;
  std::vector<Tree> members;

  static Tree of_leaf(int number) { return {.leaf = number, .members = {}}; }
  static Tree series(std::vector<Tree> members) { return {.kind = Kind::series, .members = std::move(members)}; }
  static Tree parallel(std::vector<Tree> members) { return {.kind = Kind::parallel, .members = std::move(members)}; }
};

/// Which leaf lies between which nodes. Node 0 is ground, node 1 the driven one, the others lie between.
struct Graph {
  struct Branch { int a, b; };
  int nodes = 2;
  std::vector<Branch> branches;  ///< of each leaf
};

/// The tree between the driven node and ground.
Graph wired(const Tree& tree);

/// The same tree with the members of every group in reverse order: for the drive it makes no difference.
Tree commuted(Tree tree);

/// As `series(sfm, parallel(spring, slider))`.
std::string described(const Tree& tree, const std::vector<std::string>& leaves);

}  // namespace rheonet::test
