#pragma once

#include <vector>

#include "core/solve/magnitudes.hpp"
#include "core/solve/separated_parts.hpp"

namespace rheonet {

/// The force of a slider at rest is the sum of the forces around it. These may have been many times larger while it slipped,
/// and their errors shift the position at which it stops: tolerances around it are relative to its own bound.
class SliderShares {
 public:
  /// The network must outlive this.
  explicit SliderShares(const Network& network);
  /// Call with the states at restarts and after steps.
  void see(const Dae::View& view);
  /// Call at restarts, and where forces of blocks may have begun. `block_force`: largest force that a block has given, for each force of the network [N].
  void find(Dae& dae, const std::vector<Unknown>& unknowns, const SeparatedParts& parts, const Magnitudes& seen, const std::vector<double>& block_force);
  /// Factor by which the sliders around an unknown tighten its tolerance.
  double of(std::size_t unknown) const { return share_[unknown]; }

 private:
  const Network& network_;
  std::vector<char> rested_;        ///< For each slider: it has come to rest or reversed.
  std::vector<signed char> slid_;   ///< For each slider: the direction of its last motion.
  bool any_rested_ = false;
  std::vector<double> share_;
};

}  // namespace rheonet
