#pragma once

#include <vector>

#include "core/dae/dae.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// How far rounding takes the deflections of what holds nodes without a velocity of their own (floating ones) [m].
///
/// Such a node is where its forces balance, and these are known to rounding: their own, and that of the deflections that they
/// come from, which for friction that has slid far is a large share of its force. So a deflection is known to that force over
/// the slope of what holds its ends together, which near the bound of friction is a small part of its stiffness, and changes
/// all the time.
class BalanceRounding {
 public:
  void attach(const Network& network, const Structure& structure);
  /// Nothing floats: no deflection is told by a balance.
  bool none() const { return branches_.empty(); }
  /// At this view, with the slopes df/dp of all deflection branches there [N/m].
  void find(const Dae::View& view, const std::vector<double>& slope);
  /// Of a deflection branch [m]; 0 if no balance tells it.
  double of(int branch) const { return rounding_[static_cast<std::size_t>(branch)]; }

 private:
  struct Held { int branch, a, b; };  ///< between these of the places
  void find_forces(const Dae::View& view, const std::vector<double>& slope);
  double held_together(int a, int b) const;

  const Network* network_ = nullptr;
  const Structure* structure_ = nullptr;
  std::vector<Held> branches_;
  std::vector<int> place_;      ///< of each node: 0 for all that do not float, else that of its group
  std::vector<int> component_;  ///< of each place: one that stands for all that floats together
  std::vector<double> force_;   ///< of each component: rounding of its forces [N]
  std::vector<double> rounding_;
  std::vector<int> order_;
  // Of each place: what it is joined to, by which slope [N/m], and how many are below it.
  std::vector<int> up_, size_;
  std::vector<double> by_;
};

}  // namespace rheonet
