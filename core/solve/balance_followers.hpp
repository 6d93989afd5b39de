#pragma once

#include <vector>

#include "core/solve/balanced_forces.hpp"
#include "core/solve/magnitudes.hpp"
#include "core/solve/unknown_roundoff.hpp"

namespace rheonet {

/// The unknowns whose error is that of the forces that they balance: forces of dashpots, and deflections of laws held
/// at rest, which may take any force. A dashpot's force that no balance determines follows from a velocity, and has its
/// round-off.
class BalanceFollowers {
 public:
  /// The network must outlive this.
  explicit BalanceFollowers(const Network& network) : network_(network) {}
  /// Switches to these equations.
  void attach(const Dae& dae);
  /// Call at a restart: laws may be held at rest from here on.
  void restart();
  /// Raises their tolerances to the errors of the forces. `slope`: df/dp of all deflection branches [N/m]; `local`: tolerance of a step,
  /// relative to scales.
  void raise(std::vector<double>& tolerance, const std::vector<double>& slope, const UnknownRoundoff& roundoff, const Magnitudes& seen, double local);

 private:
  void tell_errors(const std::vector<double>& tolerance, const std::vector<double>& slope, const UnknownRoundoff& roundoff, const Magnitudes& seen);

  const Network& network_;
  const Dae* dae_ = nullptr;
  std::vector<NodeId> balanced_;  ///< For each deflection branch: the node whose balance determines it, -1.
  /// A branch whose force or deflection follows from a balance. If `held`, its deflection may balance any force.
  struct Follower { Unknown::Sort sort; std::size_t index; bool held; };
  std::vector<Follower> followers_;  ///< Dashpots first, then deflections.
  BalancedForces forces_;            ///< Of the followers.
  std::vector<double> longest_at_;   ///< For each node: largest deflection at it so far [m].
};

}  // namespace rheonet
