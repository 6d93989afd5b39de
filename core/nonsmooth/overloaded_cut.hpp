#pragma once

#include <optional>
#include <vector>

namespace rheonet {

/// A branch of a graph, whose force f acts on node a and -f on node b, and lies between `low` and `high` [N] (either may be
/// infinite). A node of -1 is held: it takes any force. In a norm of forces f counts as `unit` times f.
struct BoxedBranch { int a, b; double low, high, unit = 1; };

/// A set of nodes whose load exceeds the force that the branches leaving the set can carry. The set is connected, and so is
/// the rest of the graph with its held nodes.
struct OverloadedCut {
  std::vector<char> inside;   ///< of each node
  int side = 1;               ///< the direction in which the load pushes the set
  std::vector<int> branches;  ///< branches that leave the set
  double excess = 0;          ///< load minus the largest force of the branches [N]
  bool beyond = false;        ///< the excess is more than round-off
};

/// Finds overloaded cuts for loads at the nodes of a graph. `open`: of each branch, whether it takes part; `held`: of each
/// node, whether it takes any force. The arguments must outlive this object.
class CutSearch {
 public:
  CutSearch(const std::vector<BoxedBranch>& branches, const std::vector<char>& open, const std::vector<char>& held,
            const std::vector<double>& load)
      : branches_(branches), open_(open), held_(held), load_(load) {}

  /// An overloaded cut between nodes that `direction` moves apart (a displacement of each node, 0 where it is held). Only
  /// gaps of at least `share` of the whole range of `direction` are examined. With a share of 0, returns the cut with the
  /// largest excess if no excess is more than round-off.
  std::optional<OverloadedCut> along(const std::vector<double>& direction, double share) const;

 private:
  struct Balance { double excess, rounding; };
  Balance balance(const std::vector<char>& inside, int side) const;
  bool overloaded(const std::vector<char>& inside, int side) const;
  OverloadedCut simple(std::vector<char> inside, int side) const;
  std::vector<std::vector<char>> pieces(const std::vector<char>& of, char value) const;
  bool within(const std::vector<char>& inside, int node) const { return node >= 0 && inside[static_cast<std::size_t>(node)] != 0; }

  const std::vector<BoxedBranch>& branches_;
  const std::vector<char>& open_;
  const std::vector<char>& held_;
  const std::vector<double>& load_;
};

}  // namespace rheonet
