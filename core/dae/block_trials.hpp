#pragma once

#include <string>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"
#include "core/nonsmooth/fixed_point.hpp"

namespace rheonet {

/// Trials of the steady state that blocks sense. Bounds that blocks give may depend on the motion, as friction over the speed does: the
/// steady state is found again until its bounds are those of its own motion.
class BlockTrials {
 public:
  /// Steady states at time t. All must outlive this.
  BlockTrials(const Network& network, Inputs& inputs, double t) : network_(network), inputs_(inputs), t_(t), points_(numerics::trials_combined) {}

  /// Blocks settle at the first trial.
  void begin(State& state) {
    inputs_.settle_blocks(t_, state);
    trial_ = state;
  }
  /// The present trial.
  const State& trial() const { return trial_; }
  /// True if the bounds are those at the state that was found, with these velocities; otherwise they are set to those at a next trial of it.
  /// Throws SimulationError, which begins with `refusal`, after too many trials.
  bool agree(State& state, const std::vector<double>& velocity, const std::string& refusal);

 private:
  const Network& network_;
  Inputs& inputs_;
  double t_;
  State trial_;
  int count_ = 0;  ///< After the first one.
  FixedPoint points_;
};

}  // namespace rheonet
