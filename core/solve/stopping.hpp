#pragma once

#include <limits>
#include <map>
#include <vector>

#include "core/solve/magnitudes.hpp"
#include "core/solve/stop_chains.hpp"

namespace rheonet {

/// Limits the velocity tolerance of masses that pseudoplastic dashpots stop in a finite time. The slope of f = B w^n grows
/// without bound towards rest, so the same velocity error causes a growing error of the force, and of the time of rest. The
/// tolerance keeps the force within its own allowed error.
class Stopping {
 public:
  /// The network must outlive this.
  explicit Stopping(const Network& network) : network_(network), carried_seen_(network.rates.size(), 0) {}
  /// Switches to these equations.
  void attach(const Dae& dae);
  /// Finds the limits in this state. `local`: tolerance of a step, relative to scales.
  void find(const Dae::View& view, const Magnitudes& seen, double local);
  /// Error of the velocity of a node that is allowed by the force that stops it [m/s].
  double limit(std::size_t node) const { return limit_.empty() ? std::numeric_limits<double>::infinity() : limit_[node]; }
  /// Velocity at which the force of a pseudoplastic dashpot is negligible (`numerics::negligible_force`), or is mostly round-off [m/s].
  /// Infinite as long as the dashpot has had no force.
  double unfelt(int rate, const Magnitudes& seen, double local) const;

 private:
  /// Groups the nodes that transmissions join, with their relative scales.
  void find_geared(const Structure& structure);
  double carried_noise(std::size_t rate, double local) const;

  /// A node of a transmission, or joined to one. All that transmissions join are a group; |velocity| times `scale` is of one size in it.
  struct Geared { std::size_t group; double scale; };

  const Network& network_;
  std::map<NodeId, Geared> geared_;
  std::vector<char> cancelling_;  ///< For each group: velocities of three nodes in it sum to 0, and may cancel.
  std::vector<StopChain> chains_;      ///< In the present modes.
  std::vector<double> limit_;          ///< For each node; empty without power laws.
  std::vector<double> carried_seen_;   ///< For each rate branch: largest velocity common to both ends, or of a transmission that moves one [m/s].
};

}  // namespace rheonet
