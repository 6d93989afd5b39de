#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Round-off of the deflections of branches at floating nodes, that is nodes whose velocity is in no force balance [m].
///
/// The position of such a node follows from its force balance. The forces there carry round-off: their own, and that of the
/// deflections that they follow from. The latter is a large share of the force of friction that has slid far. So the
/// round-off of a deflection is that of the forces over the slope that holds its ends together. Near the bound of friction
/// this slope is a small part of the initial stiffness, and it changes all the time.
class BalanceRounding {
 public:
  void attach(const Network& network, const Structure& structure);
  /// True if no deflection follows from a force balance.
  bool none() const { return branches_.empty(); }
  /// Finds the round-off in this view, with the slopes df/dp of all deflection branches there [N/m].
  void find(const Dae::View& view, const std::vector<double>& slope);
  /// Round-off of a deflection branch [m]; 0 if it follows from no balance.
  double of(int branch) const { return rounding_[static_cast<std::size_t>(branch)]; }

 private:
  struct Held { int branch, a, b; };  ///< between the places a and b
  void find_forces(const Dae::View& view, const std::vector<double>& slope);
  double held_together(int a, int b) const;

  const Network* network_ = nullptr;
  const Structure* structure_ = nullptr;
  std::vector<Held> branches_;
  std::vector<int> place_;      ///< of each node: 0 if it does not float, else 1 + its group
  std::vector<int> component_;  ///< of each place: the representative of its connected floating places
  std::vector<double> force_;   ///< of each component: largest round-off of its forces [N]
  std::vector<double> rounding_;
  std::vector<int> order_;
  // Maximum spanning tree: each place's parent, slope of the branch to it [N/m], and size of the subtree.
  std::vector<int> up_, size_;
  std::vector<double> by_;
};

}  // namespace rheonet
