#pragma once

#include <vector>

#include "core/dae/drive.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Reversals of laws with a memory, and of sliders, between nodes that are both prescribed: known beforehand, so that no
/// step can miss them.
class GivenReversals {
 public:
  /// `classified` is the network's structure with every slider slipping. All must outlive this.
  GivenReversals(const Network& network, const Structure& classified, Drive& drive);

  /// The first after t [s]; infinite if there is none before `limit`.
  double next(double t, double limit) const;

 private:
  const Structure& structure_;
  Drive& drive_;
  std::vector<Branch> pairs_;  ///< each pair of ends once
};

}  // namespace rheonet
