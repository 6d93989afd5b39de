#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/unknown_indices.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Gives blocks their states and what they sense of a network, and the inputs the outputs that follow.
class BlockSensors {
 public:
  /// All must outlive this.
  BlockSensors(const Network& network, const Structure& structure, Inputs& inputs, const UnknownIndices& index)
      : network_(network), structure_(structure), inputs_(inputs), index_(index) {}

  /// Evaluates the velocities that blocks give before the laws, as they need states and positions alone. Only for Inputs::moves_by_blocks.
  void move_nodes(const double* y);
  /// Quantities that blocks may sense: velocities of nodes, deflections of branches, arguments of rate laws.
  struct Felt { const std::vector<double>&velocity, &deflection, &rate_argument; };
  /// Evaluates the states and sensor values; then all outputs.
  void feel(const double* y, const Felt& felt);
  /// Acceleration of a known node [m/s^2]: `a` by functions of time, and that by a block due to the
  /// states, and the positions whose rates are `v`.
  double acceleration(NodeId node, const std::vector<double>& a, const std::vector<double>& v) const {
    const int m = structure_.motion[at(node)];
    return a[at(node)] + (m >= 0 && network_.motions[at(m)].block >= 0 ? acceleration_by(network_.motions[at(m)], v) : 0);
  }
  /// Limiters take the sides that fit the state last felt: see BlockSignals::choose.
  void choose_sides();

 private:
  double acceleration_by(const Network::Motion& motion, const std::vector<double>& v) const;

  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  const UnknownIndices& index_;
};

}  // namespace rheonet
