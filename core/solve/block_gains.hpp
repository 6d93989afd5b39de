#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/dae/block_signals.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// How much the recorded outputs of blocks (as they are, or as forces) change with the quantities that they follow from: the largest
/// magnitude of each derivative so far. Delays pass everything; a limiter at its bound passes nothing.
class BlockGains {
 public:
  explicit BlockGains(const Network& network);
  /// To be called where limiters may have gone over to another side.
  void follow(const BlockSignals& signals);

  /// Visits (block, sort, index, gain, how many quantities the output follows from). `index` is that of a node of the network, or of
  /// a block with a state.
  enum class Of { position, velocity, state };
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& [block, gains] : gains_) {
      for (const auto& [of, gain] : gains) visit(block, of.first, of.second, gain, static_cast<double>(gains.size()));
    }
  }

 private:
  struct Derivatives { std::vector<double> of_state, of_sensor; };
  Derivatives derivatives_of(int output) const;

  const Blocks& blocks_;
  std::vector<int> sides_;  ///< of each block, at the last `follow`
  std::map<int, std::map<std::pair<Of, int>, double>> gains_;  ///< of each recorded output
};

}  // namespace rheonet
