#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"
#include "core/solve/tolerances.hpp"

namespace rheonet {

/// Regularises power laws, whose slope at rest would be 0 or infinite: each is linear up to some velocity.
class Regularisation {
 public:
  /// The network must outlive this.
  explicit Regularisation(const Network& network);

  /// Switches to the modes with this structure.
  void attach(const Structure& structure);
  /// Call at the start of a run, with the velocities of all nodes [m/s]. A dilatant law has slope 0 at rest and would leave
  /// its ends free: it is linear up to the round-off of the velocity expected from the inputs, which gives it some slope.
  void begin(const Inputs& inputs, const std::vector<double>& velocity);
  /// Makes each law linear up to the velocity resolved. A law changes only if that velocity has changed by a factor of 2.
  void apply(const Tolerances& tolerances);

 private:
  const Network& network_;
  double slowest_stop(std::size_t rate, const Growth& growth) const;
  std::vector<double> applied_;         ///< For each rate branch: linear up to this velocity [m/s]; not_given before `apply`.
  std::vector<double> least_velocity_;  ///< For each dilatant rate branch: least such velocity [m/s].
  /// For each rate branch: pseudoplastic, and it may bring a mass to rest, or it is one of several in series that do so or
  /// that start from rest together. The force of any other pseudoplastic law follows from its neighbours, and its velocity
  /// from that force: it needs no regularisation.
  std::vector<char> stops_;
  std::vector<char> follows_;  ///< For each rate branch: its force follows from the velocities of masses and motions.
  std::vector<double> mass_;  ///< Reduced mass that it stops, with others in series [kg]; 0 if none.
};

}  // namespace rheonet
