#pragma once

#include <vector>

#include "core/dae/convex.hpp"
#include "core/dae/state.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Contacts of rigid stops in the search for a steady state, by the augmented Lagrangian (M. J. D. Powell and M. R. Hestenes 1969): each is a
/// spring beyond its bounds, preloaded with the force that is estimated. With the right estimate the displacement is at the bound.
class SteadyContacts {
 public:
  /// Both must outlive this.
  SteadyContacts(const Network& network, const State& state) : network_(network), state_(state), pressed_(network.sliders.size(), 0) {}

  /// Opens all contacts: the steady state decides anew which of them are closed. `load`: the largest load [N].
  void open(double load);
  /// Force of a slider with a gauge over its step from the present displacement.
  ConvexNetwork::Law law(std::size_t slider) const;
  /// Takes the force of a contact at this step as its next estimate. True if its displacement is not at its bound yet.
  bool press(std::size_t slider, double step, double force);

 private:
  const Network& network_;
  const State& state_;
  std::vector<double> pressed_;  ///< For each slider with a gauge: estimate of its force [N].
  double stiffness_ = 0;         ///< For these estimates [N/m].
};

}  // namespace rheonet
