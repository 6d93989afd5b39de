#pragma once

#include <Eigen/Sparse>
#include <functional>
#include <vector>

#include "core/network/index.hpp"

namespace rheonet {

/// A network of set-valued monotone laws, and the values x of its nodes at which everything balances:
///
///     inertia_n u_n + sum of +-f_b = applied_n    at every free node,     f_b in law_b(x_a - x_b)
///
/// where u is the change of x from what it starts from. That is the minimum of a convex function, found by Newton's method
/// on an active set with exact line search. A branch whose law jumps at 0 joins its ends while its force stays within the
/// jump. The change of a heavy node may be far below the rounding of x, and its force not below that of others: so they are
/// kept apart. The same holds for w = x_a - x_b of a branch: steps add to it, so that a small w keeps all its digits. x stands for
/// velocities, or for displacements: see instant.cpp and jump.cpp.
class ConvexNetwork {
 public:
  struct Law {
    double low = 0, high = 0;          ///< force at w = 0 lies between them
    double backward = 0, forward = 0;  ///< slopes for w < 0 and w > 0
    double rounding = 0;               ///< what the force is known to
    bool of_change = false;            ///< w is the change alone, not counted from 0
    /// If given: force and slope for w != 0, in place of low + backward w and high + forward w.
    std::function<double(double w, double& slope)> beyond = {};
  };

  explicit ConvexNetwork(int nodes);
  /// What the node starts from: 0 unless said.
  void start(int node, double value) { origin_[at(node)] = base_[at(node)] = value; }
  /// The change of the node is given.
  void fix(int node, double change);
  void load(int node, double applied) { applied_[at(node)] += applied; }
  void set_inertia(int node, double inertia) { inertia_[at(node)] = inertia; }
  /// Returns the index of the branch.
  int add(int a, int b, Law law);
  /// A guess that only saves time: the branch, whose law jumps, had its ends apart before, to this side.
  void was_apart(int branch, int side) { branches_[at(branch)].before = side; }

  enum class Outcome {
    solved,
    unbounded,  ///< nothing balances what is applied, however large x
    undecided,  ///< rounding stands in the way
  };
  Outcome solve();

  double value(int node) const { return base_[at(node)] + u_[at(node)]; }
  double difference(int a, int b) const;
  /// Of a branch, after `solve`.
  double force(int branch) const;
  struct Bounds { double low, high; };
  /// Between which the force of a branch lies as long as it joins its ends.
  Bounds bounds(int branch) const { return {branches_[at(branch)].law.low, branches_[at(branch)].law.high}; }
  /// Sign of w: 0 for a branch that joins its ends, the side of its force's bound where others keep its ends together.
  int direction(int branch) const;
  /// After `solve`: branches that join their ends hold these nodes together.
  bool joined(int a, int b) const { return cluster_[at(a)] == cluster_[at(b)]; }
  /// That `solve` took.
  std::size_t rounds() const { return rounds_; }
  /// Nodes that ran away, if the outcome is `unbounded`.
  const std::vector<int>& runaways() const { return runaways_; }

 private:
  struct Branch {
    int a, b;
    Law law;
    bool jumps;           ///< low < high; never a law of the change
    double weak = 0;      ///< slope that decides among equals, where there is no other
    double w = 0;         ///< argument of the law
    bool stuck = false;
    bool apart = false;  ///< before the last step
    int side = 1;  ///< where it is free and w is 0
    int before = 0;  ///< see was_apart; 0: no guess
  };
  /// As the nodes have it.
  double nodal_difference(const Branch& b) const {
    return b.law.of_change ? change(b.a) - change(b.b) : difference(b.a, b.b);
  }
  double change(int node) const { return (base_[at(node)] - origin_[at(node)]) + u_[at(node)]; }
  void follow(int node, int head);
  double force(const Branch& b, double w, int side) const;
  double slope(const Branch& b, double w) const;
  double slope_along(const std::vector<double>& d, double step) const;
  void choose_weak();
  void stick_at_first();
  bool stick_where_met();
  bool stick_where_idle();
  void merge();
  bool balanced(std::vector<double>& gradient) const;
  bool direction_of_descent(const std::vector<double>& gradient, std::vector<double>& d, bool secants);
  Outcome search(const std::vector<double>& d);
  bool release();
  void release_as_before();
  bool run_away();
  bool flattened(const std::vector<double>& gradient);
  double power() const;
  void find_bond_forces();

  std::vector<double> origin_;    ///< what x starts from
  std::vector<double> base_, u_;  ///< x = base + u; base is the origin of the node, or of the heavy one that it goes with
  std::vector<double> inertia_, applied_;
  std::vector<char> fixed_;
  std::vector<Branch> branches_;
  std::vector<int> cluster_;  ///< of each node: the cluster that sticking branches make
  std::vector<int> head_;     ///< of each cluster: its fixed or heaviest node
  std::vector<int> column_;   ///< of each cluster: its unknown, -1 if it holds a fixed node
  int columns_ = 0;
  std::vector<int> released_;  ///< at the last release, the worst first
  int full_steps_ = 0;  ///< in a row
  std::size_t rounds_ = 0;
  std::vector<int> runaways_;
  std::vector<double> bond_force_;  ///< of each branch that sticks
};

}  // namespace rheonet
