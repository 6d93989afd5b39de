#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"
#include "core/dae/unknown_indices.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Positions of nodes between events: of known nodes, and of those that are asked for, each from the position of its parent (see Position).
class NodePositions {
 public:
  /// All must outlive this.
  NodePositions(const Network& network, const Structure& structure, const Inputs& inputs, const Positions& positions, const UnknownIndices& index)
      : network_(network), structure_(structure), inputs_(inputs), positions_(positions), index_(index),
        slider_shift_(network.sliders.size(), 0), tied_sum_(structure.train_equations.size(), 0) {}

  /// Counts from this state, under the inputs last evaluated. Writes the unknowns of positions that are integrated.
  void enter(const State& state, double* y);
  /// Displacement of a branch that does not creep, to the last digit of its deflection. `p`: for each deflection branch.
  double displacement(int branch, const std::vector<double>& p) const { return p[at(branch)] + offset_[at(branch)]; }
  /// Writes all positions.
  void evaluate(const std::vector<double>& p, const double* y, std::vector<double>& positions) const;

 private:
  std::vector<double> places(const State& state) const;

  const Network& network_;
  const Structure& structure_;
  const Inputs& inputs_;
  const Positions& positions_;
  const UnknownIndices& index_;
  std::vector<double> offset_;        ///< Displacement less deflection of each deflection branch that does not creep.
  std::vector<double> slider_shift_;  ///< Displacement of each sticking slider.
  std::vector<double> tied_sum_;      ///< For each equation of a train: the sum of the positions of its nodes, times their factors [m].
};

}  // namespace rheonet
