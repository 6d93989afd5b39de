#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/dae/block_signals.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Sensitivity of the recorded outputs of blocks (recorded directly, or as forces) to the quantities that they depend on:
/// the largest magnitude so far of each derivative. A delay has gain 1; a limiter at its bound has gain 0; a function has those of
/// its derivatives.
class BlockGains {
 public:
  explicit BlockGains(const Network& network);
  /// Call whenever a limiter may have reached or left a bound, or a function may have another slope.
  void follow(const BlockSignals& signals);

  /// Visits (block, sort, index, gain, number of quantities that the output depends on). `index` is that of a node of the
  /// network, or of a block with a state.
  enum class Of { position, velocity, state };
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& [block, gains] : gains_) {
      for (const auto& [of, gain] : gains) visit(block, of.first, of.second, gain, static_cast<double>(gains.size()));
    }
  }

 private:
  struct Derivatives { std::vector<double> of_state, of_sensor; };
  Derivatives derivatives_of(int output, const BlockSignals& signals) const;

  const Blocks& blocks_;
  std::vector<int> sides_;  ///< of each block, at the last `follow`
  std::map<int, std::map<std::pair<Of, int>, double>> gains_;  ///< of each recorded output
};

}  // namespace rheonet
