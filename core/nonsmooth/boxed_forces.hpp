#pragma once

#include <memory>
#include <vector>

#include "core/nonsmooth/overloaded_cut.hpp"

namespace rheonet {

/// Forces in boxes that balance the loads at the nodes of a graph; where the balance leaves them open, those of least norm:
///
///     minimise 1/2 sum (unit_k f_k)^2     subject to     sum of +-f_k = load_n  at every node,     low_k <= f_k <= high_k
///
/// Its dual is convex, piecewise quadratic and without constraints. Its unknowns are potentials phi of the nodes (0 where a
/// node is held), and f_k = clamp(c_k (phi_a - phi_b), low_k, high_k) with the conductance c_k = 1/unit_k^2. Newton's method on the active set, with exact line search, finds
/// its minimum, where every node balances. (A quadratic network flow: Bertsekas, Network Optimization, 1998, chapter 8.)
///
/// Where the dual has no minimum, a cut is overloaded. The branches of that cut then exceed their bounds, all by the same share,
/// so that every node still balances.
class BoxedForces {
 public:
  /// Each node has a path along branches to a held one.
  BoxedForces(int nodes, std::vector<BoxedBranch> branches);
  BoxedForces(BoxedForces&&) noexcept;
  BoxedForces& operator=(BoxedForces&&) noexcept;
  ~BoxedForces();

  /// Gives a branch other bounds [N].
  void bound(std::size_t branch, double low, double high) {
    branches_[branch].low = low;
    branches_[branch].high = high;
  }

  enum class Outcome {
    within,  ///< Every force is in its box.
    beyond,  ///< Cuts are overloaded: see `cuts`.
    failed,  ///< A condition is not met to round-off: see `failed_node` and `failed_branch`.
  };
  /// `load`: of each node [N], finite. Writes the force of each branch into `force`.
  Outcome solve(const std::vector<double>& load, std::vector<double>& force);

  const std::vector<OverloadedCut>& cuts() const { return cuts_; }
  /// A node that does not balance, or -1.
  int failed_node() const { return failed_node_; }
  /// A branch whose force does not follow from the potentials by the least-norm condition, or -1.
  int failed_branch() const { return failed_branch_; }

 private:
  struct Factors;
  double difference(std::size_t k, const std::vector<double>& of_nodes) const { return of_nodes[ends_[k].a] - of_nodes[ends_[k].b]; }
  double conductance(std::size_t k) const;
  double force_at(std::size_t k, double step) const;
  double round_off(std::size_t node) const;
  bool balanced(const std::vector<double>& load, const std::vector<double>& force);
  bool balanced_to_largest(const std::vector<double>& load, const std::vector<double>& force);
  bool without_bounds(const std::vector<double>& load, std::vector<double>& force);
  void find_direction();
  double slope_at(double step) const;
  double minimum_along() const;
  void move(double step);
  void give_way(const OverloadedCut& cut, std::vector<double>& load, std::vector<double>& force);
  bool of_least_norm(const std::vector<double>& force);

  struct Ends { std::size_t a, b; };
  std::vector<BoxedBranch> branches_;
  std::vector<Ends> ends_;            ///< For each branch; held ends share the index after the last node.
  std::unique_ptr<Factors> factors_;  ///< Factors of the Laplacian of all branches.
  std::vector<double> difference_;    ///< For each branch: c (phi_a - phi_b) [N]; stored apart because phi has larger round-off.
  std::vector<double> phi_, direction_, along_;  ///< `along_`: of each branch, c times the difference of `direction_`.
  std::vector<double> left_, magnitude_;         ///< For each node: force out of balance, sum of magnitudes [N].
  std::vector<int> terms_;                       ///< For each node: number of terms.
  std::vector<char> held_;  ///< For each node: its balance follows from the balances of other nodes.
  std::vector<char> open_;  ///< For each branch: it is in no overloaded cut.
  double grain_ = 0;        ///< round-off of a difference of potentials [N].
  std::vector<OverloadedCut> cuts_;
  int failed_node_ = -1, failed_branch_ = -1;
};

}  // namespace rheonet
