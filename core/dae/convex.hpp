#pragma once

#include <Eigen/Sparse>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/node_clusters.hpp"

namespace rheonet {

struct Conductance;

/// A network of set-valued monotone laws, and the values x of its nodes at which everything balances:
///
///     inertia_n u_n + sum of +-f_b + sum of factor_cn f_c = applied_n    at every free node,     f_b in law_b(x_a - x_b),
///     sum over n of factor_cn (change of x_n) = given_c                  for every equation c between nodes
///
/// where u is the change of x from its start value. This x minimises a convex function; Newton's method on an active set, with
/// exact line search, finds it. A branch whose law jumps at 0 sticks (joins its ends) while its force stays within the jump.
/// Increments u are stored apart from x: the increment of a heavy node can be below one ulp of x while its inertial force still
/// matters. Likewise steps add to w = x_a - x_b of a branch, so that a small w keeps all its digits. x stands for velocities,
/// as in mode_selection.cpp, or for displacements, as in quasistatic_jump.cpp.
class ConvexNetwork {
 public:
  struct Law {
    double low = 0, high = 0;          ///< Bounds of the force at w = 0.
    double backward = 0, forward = 0;  ///< Slopes for w < 0 and w > 0.
    double rounding = 0;               ///< A magnitude: the force is known to its round-off.
    bool of_change = false;            ///< w is counted from the start values, not from 0.
    bool inertial = false;             ///< It holds its ends together as the inertia of a node holds this node.
    /// If set: force and slope for w != 0, in place of low + backward w and high + forward w.
    std::function<double(double w, double& slope)> beyond = {};

    /// A force without a bound holds the ends together, or ends a motion to the side of w that the law forbids.
    bool forbids(double w) const { return std::isinf(w < 0 ? low : high); }
  };

  explicit ConvexNetwork(int nodes);
  /// Start value of the node: 0 by default.
  void start(int node, double value) { origin_[at(node)] = base_[at(node)] = value; }
  /// Prescribes the change of the node.
  void fix(int node, double change);
  void load(int node, double applied) { applied_[at(node)] += applied; }
  void set_inertia(int node, double inertia) {
    inertia_[at(node)] = inertia;
    any_inertia_ = true;
  }
  /// Returns the index of the branch.
  int add(int a, int b, Law law);
  /// The changes of these nodes, times their factors, sum to `given`. Where any node has an inertia, these have one, or follow from those
  /// that have.
  void tie(const std::array<int, 3>& nodes, const std::array<double, 3>& factors, double given);
  /// The force of each equation, in the order of `tie`, after `solve`.
  std::vector<double> forces_of_equations() const;
  /// Joins the third node of an equation to the other two where these are together, if the equation permits equal values, or the two stand still.
  /// After `solve`.
  void join_by_equations(DisjointSets& sets) const;
  /// The largest of all loads and forces, those of sticking branches left out.
  double largest_force() const;
  /// A guess that only saves time: this branch, whose law jumps, slipped to this side before.
  void was_apart(int branch, int side) { branches_[at(branch)].before = side; }

  enum class Outcome {
    solved,
    unbounded,  ///< No x balances the applied forces, however large.
    undecided,  ///< round-off prevents a decision.
  };
  /// The outcome is `solved` only if the forces balance at every node, to round-off of forces and values and `numerics::answer_imbalance` of the largest force.
  Outcome solve();

  double value(int node) const { return base_[at(node)] + u_[at(node)]; }
  /// Change from the start value.
  double change(int node) const { return (base_[at(node)] - origin_[at(node)]) + u_[at(node)]; }
  double difference(int a, int b) const;
  /// Force of a branch, after `solve`.
  double force(int branch) const;
  struct Bounds { double low, high; };
  /// Bounds of the force of a branch while it joins its ends.
  Bounds bounds(int branch) const { return {branches_[at(branch)].law.low, branches_[at(branch)].law.high}; }
  /// Sign of w: 0 for a branch that joins its ends, the side of its force's bound if only others keep its ends together.
  int direction(int branch) const;
  /// Sign of w: 0 also for a branch at a bound whose ends others keep together.
  int motion(int branch) const {
    const double w = branches_[at(branch)].w;
    return w > 0 ? 1 : w < 0 ? -1 : 0;
  }
  /// Whether sticking branches join these nodes. After `solve`.
  bool joined(int a, int b) const { return clusters_.joined(a, b); }
  /// Whether a prescribed node cannot move as prescribed, because laws without a bound hold it to another one: then the nodes that these, and equations, join to it.
  /// After `solve`.
  bool torn(int node) const { return !torn_.empty() && torn_[at(node)]; }
  bool torn_with(int node, int other) const { return torn_clusters_.joined(node, other); }
  /// Iterations of the last `solve`.
  std::size_t rounds() const { return rounds_; }
  /// Nodes that run away, if the outcome is `unbounded`.
  const std::vector<int>& runaways() const { return runaways_; }

 private:
  struct Branch {
    int a, b;
    Law law;
    bool jumps;           ///< Low < high; never a law of the change.
    double weak = 0;      ///< Regularising slope, where the law is flat: makes the answer unique.
    double w = 0;         ///< Argument of the law.
    bool stuck = false;
    bool apart = false;  ///< w != 0 before the last step.
    int side = 1;  ///< The bound at which the force is while the branch slips and w is 0.
    int before = 0;  ///< See was_apart; 0: no guess.

    /// Force and slope at w; at w = 0 those beside that side of it, or beside `side`.
    double force(double w, int of_side) const;
    double slope(double w) const;
  };
  struct Equation {
    std::array<int, 3> node;
    std::array<double, 3> factor;
    double given;
    double force = 0;
    bool equal = false, homogeneous = false;  ///< It permits equal values; values that meet it sum, times the factors, to 0.
  };
  /// Its value does not follow from the forces of branches alone.
  bool firm(std::size_t node) const { return fixed_[node] || inertia_[node] > 0 || tied_[node]; }
  /// It needs no regularising slope, and cannot run away.
  bool restrained(std::size_t node) const { return restrained_[node]; }
  Outcome minimise();
  void find_restrained();
  std::vector<std::vector<double>> equations_of_columns(Eigen::VectorXd& left) const;
  bool step_within_equations(const std::vector<Conductance>& slopes, Eigen::VectorXd& step);
  std::vector<char> dependent_equations() const;
  std::vector<std::size_t> open_equations() const;
  void classify_equations();
  void share_with_open_equations(const std::vector<std::size_t>& open, const std::vector<int>& row, const Eigen::VectorXd& load, double roundoff);
  double torn(const Equation& equation) const;
  bool part_torn_equations();
  bool beside_torn_equation(int node) const;
  void open_for_equations();
  void meet_equations();
  /// Argument of the law, from the values of the nodes.
  double nodal_difference(const Branch& b) const {
    return b.law.of_change ? change(b.a) - change(b.b) : difference(b.a, b.b);
  }
  void follow(int node, int head);
  double slope_along(const std::vector<double>& d, double step) const;
  void choose_weak();
  void stick_at_first();
  bool stick_where_met();
  void stick_where_forbidden();
  void let_prescribed_part();
  void tear(const std::function<bool(int)>& is);
  bool is_torn(int node) const;
  bool part_torn();
  bool stick_where_idle();
  void merge();
  struct Sums {
    std::vector<double> laws, all;  ///< Sums of forces at each column, without and with the forces of equations.
    std::vector<double> rounding;   ///< of these sums.
  };
  bool balanced(Sums& sums) const;
  bool answer_balances(Sums& sums) const;
  double roundoff_along(const std::vector<double>& d, const Sums& sums) const;
  bool direction_of_descent(const std::vector<double>& sum_of_laws, std::vector<double>& d, bool secants);
  Outcome search(const std::vector<double>& d, bool gains);
  bool release();
  void release_as_before();
  bool run_away();
  bool flattened(const std::vector<double>& sums);
  void find_bond_forces(double roundoff = 0);
  bool bonds_hold();

  std::vector<double> origin_;    ///< Start value of x.
  std::vector<double> base_, u_;  ///< x = base + u; base is the start value of the node, or of the heavy node that it follows.
  std::vector<double> inertia_, applied_;
  std::vector<char> fixed_, tied_;
  bool any_inertia_ = false;
  std::vector<char> restrained_;  ///< each node: see restrained
  std::vector<Equation> equations_;
  std::vector<double> given_;  ///< Prescribed change of each fixed node.
  std::vector<Branch> branches_;
  NodeClusters clusters_;  ///< Nodes that sticking branches and equations join.
  std::vector<char> torn_;     ///< For each node, if any is: see torn.
  NodeClusters torn_clusters_;
  std::vector<int> released_;  ///< Branches of the last release, the worst first.
  int full_steps_ = 0;  ///< Full Newton steps in a row.
  std::size_t rounds_ = 0;
  std::vector<int> runaways_;
  std::vector<double> bond_force_;  ///< For each branch that sticks.
  bool in_doubt_ = false;           ///< round-off prevented these.
  struct Beyond {
    double over;  ///< By how much, or with which share.
    int branch, side;
  };
  std::vector<Beyond> beyond_;  ///< Sticking branches that cannot hold their forces.
};

}  // namespace rheonet
