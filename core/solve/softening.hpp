#pragma once

#include <vector>

#include "core/dae/drive.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// About how far power laws are taken as linear around rest, where their slope would be 0 or infinite.
class Softening {
 public:
  /// The network must outlive this.
  explicit Softening(const Network& network);

  /// Goes over to the modes with this structure.
  void attach(const Structure& structure);
  /// At the start, with the velocities of all nodes. Dilatant laws that start from rest would let their ends go there:
  /// rounding of the velocities that the drive comes to gives them some slope.
  void begin(const Drive& drive, const std::vector<double>& velocity);
  /// As far as the velocities below which nothing is resolved; of each law not again as long as that is about the same.
  void apply(const Tolerances& tolerances);

 private:
  const Network& network_;
  double slowest_stop(std::size_t rate, const Growth& growth) const;
  std::vector<double> applied_;         ///< of each rate branch [m/s]; not_given before the first time
  std::vector<double> least_velocity_;  ///< of each rate branch [m/s]
  /// Of each rate branch: it may bring a mass to rest, or it is one of several in series that do, or that begin at rest
  /// together. Elsewhere what a pseudoplastic law carries is told by its neighbours, and its velocity follows from that down
  /// to nothing.
  std::vector<char> stops_;
  std::vector<double> mass_;  ///< of each rate branch: that it brings to rest, with others in series [kg]; 0 where it does not
};

}  // namespace rheonet
