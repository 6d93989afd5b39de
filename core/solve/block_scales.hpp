#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/solve/block_gains.hpp"
#include "core/solve/magnitudes.hpp"

namespace rheonet {

/// BySort from blocks. A gain turns a small error of its input into a large error of its output: the unknowns behind a
/// recorded output share its allowed error equally. A position behind a force may be off by the allowed error of the force
/// over its slope: a stop in the way of a far-travelling mass deflects little. Contact at speed v causes a force v sqrt(k m).
/// A state that acts by the force of its law alone need not be resolved finer than the smallest forces are.
class BlockScales {
 public:
  /// The network must outlive this.
  explicit BlockScales(const Network& network);
  /// Call at restarts: a limiter may have reached or left a bound.
  void follow(Dae& dae);
  /// Finds the scales in this state. `foreseen`: sizes that the unknowns are to reach soon. `local`: tolerance of a step, relative to scales; `largest_force` of the run [N].
  void find(Dae& dae, const Dae::View& view, const Magnitudes& seen, const ByUnknown& foreseen, double largest_force, double local);

  /// The scale of an unknown, from what it is without blocks.
  double limit(const Unknown& q, double scale) const { return network_.blocks.blocks.empty() ? scale : std::min(scale, rheonet::of(most_, q)); }
  /// Raises the scale of a state to the least that its force asks for.
  double raise(const Unknown& q, double scale) const {
    return q.sort == Unknown::Sort::block && !least_state_.empty() ? std::max(scale, least_state_[q.index]) : scale;
  }
  /// A block senses the position of this node: it may be a small motion beside large ones.
  bool senses_position(std::size_t node) const { return sensed_[node] != 0; }
  /// For each force of the network: largest magnitude if a block gives it [N].
  const std::vector<double>& force_seen() const { return force_seen_; }

 private:
  void find_states_of_laws(Dae& dae);
  void find_behind_forces(Dae& dae, const Dae::View& view, double largest_force);

  const Network& network_;
  BlockGains gains_;
  ByUnknown most_;                 ///< Largest scale that blocks allow.
  std::vector<double> least_state_;   ///< For each state of a block: its least scale.
  std::optional<std::vector<std::pair<int, std::size_t>>> states_of_laws_;  ///< Block of a force, state: those that act by that force alone.
  std::vector<double> output_seen_;   ///< For each block: largest magnitude of its output.
  std::vector<double> force_seen_;
  std::vector<char> sensed_;          ///< For each node.
};

}  // namespace rheonet
