#pragma once

#include <vector>

#include "core/base/index.hpp"
#include "core/dae/block_past.hpp"

namespace rheonet {

/// Derivatives of the outputs of blocks, and of the rates of their states, by their atoms: the states first, then the sensor values.
class BlockSlopes {
 public:
  /// `blocks` must outlive this.
  explicit BlockSlopes(const BlockSignals& blocks) : blocks_(blocks) {}
  /// Call once, when the blocks know their states, and what their delays depend on.
  void find_dependence();

  std::size_t atoms() const { return atoms_; }
  double of_output(int block, std::size_t atom) const {
    refresh();
    return slope_[at(block) * atoms_ + atom];
  }
  double of_rate(std::size_t state, std::size_t atom) const {
    refresh();
    return rate_slope_[state * atoms_ + atom];
  }
  /// Whether an output can depend on an atom at the same time, if only when a sample is taken.
  bool depends(int block, std::size_t atom) const { return depends_[at(block) * atoms_ + atom] != 0; }
  /// The same between samples.
  bool follows(int block, std::size_t atom) const { return follows_[at(block) * atoms_ + atom] != 0; }
  /// The same for an output, or for the rate of a state, through delays shorter than a step as well.
  bool couples(int block, std::size_t atom) const { return couples_[at(block) * atoms_ + atom] != 0; }
  bool couples(int block) const;
  bool rate_couples(std::size_t state, std::size_t atom) const { return rate_couples_[state * atoms_ + atom] != 0; }

  /// Sides of limiters have changed.
  void find();
  /// The derivatives of functions may have changed: finds all anew when they are asked for.
  void expire() { stale_ = true; }
  /// Finds all anew if the derivatives of delayed outputs by the present atoms have changed.
  void update(const DelayHistory& history);

 private:
  enum class Of { values, magnitudes, magnitudes_when_sampling };
  void find(Of what, const std::vector<double>& of_delays, std::vector<double>& slope, std::vector<double>& rate_slope) const;
  void refresh() const;

  const BlockSignals& blocks_;
  std::size_t atoms_ = 0;
  mutable std::vector<double> slope_, rate_slope_;
  mutable bool stale_ = false;
  std::vector<double> delay_slope_;
  std::vector<char> depends_, follows_, couples_, rate_couples_;
};

}  // namespace rheonet
