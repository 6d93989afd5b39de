#pragma once

#include <vector>

#include "core/dae/drive.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// About how far power laws are taken as linear around rest, where their slope would be 0 or infinite.
class Softening {
 public:
  /// The network must outlive this.
  explicit Softening(const Network& network) : network_(network), least_velocity_(network.rates.size(), 0) {}

  /// At the start, with the velocities of all nodes. Dilatant laws that start from rest would let their ends go there:
  /// rounding of the velocities that the drive comes to gives them some slope.
  void begin(const Drive& drive, const std::vector<double>& velocity);
  /// As far as the velocity [m/s] below which nothing is resolved.
  void apply(double unresolved_velocity) const;

 private:
  const Network& network_;
  std::vector<double> least_velocity_;  ///< of each rate branch [m/s]
};

}  // namespace rheonet
