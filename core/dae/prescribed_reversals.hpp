#pragma once

#include <set>
#include <utility>

#include "core/dae/inputs.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Reversals of laws with a memory, and of sliders, between two prescribed nodes: known beforehand, so that no step can miss
/// them.
class PrescribedReversals {
 public:
  /// `classified` is the network's structure with every slider slipping. The inputs must outlive this.
  PrescribedReversals(const Network& network, const Structure& classified, Inputs& inputs);

  /// Time of the first reversal after t [s]; infinite if there is none before `limit`.
  double next(double t, double limit) const;

 private:
  Inputs& inputs_;
  std::set<std::pair<int, int>> pairs_;  ///< of motions (-1: ground) that move against each other: each pair once
};

}  // namespace rheonet
