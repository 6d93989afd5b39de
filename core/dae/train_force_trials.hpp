#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/dae/inputs.hpp"
#include "core/nonsmooth/fixed_point.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Trial forces of the trains. The bounds of losses depend on the forces of their trains, which follow from a balance of forces within
/// these bounds: the balance is solved again until both agree. Each is a piecewise linear function of the other, which a combination of
/// trials (FixedPoint) meets.
class TrainForceTrials {
 public:
  /// `forces`: size of the forces in the balance [N]. Trials that agree to their round-off agree.
  TrainForceTrials(const Network& network, const Inputs& inputs, const std::vector<double>& first, double forces);

  /// Trials around forces from large to small: of all trains with losses alike, of either sign, and with one of them of the other sign. The
  /// relation is linear around each. For one train, one of these lines leads to forces that agree if there are any.
  static std::vector<TrainForceTrials> around(const Network& network, const Inputs& inputs, double forces);

  /// The trial forces of all trains [N].
  std::vector<double> trial() const { return {trial_.begin(), trial_.end()}; }
  /// Takes the forces that a balance with this trial has, `forces` the size of all forces there [N]. True if both agree to round-off; otherwise `trial` is the next one.
  bool agree(const std::vector<double>& found, double forces = 0);
  /// True after so many trials that the forces will not agree.
  bool endless() const;

 private:
  const Network* network_;
  const Inputs* inputs_;
  double forces_, off_ = std::numeric_limits<double>::infinity();
  int count_ = 0;
  bool near_ = false;    ///< the second trial is near the first
  bool stalls_ = false;  ///< the last trial was no closer than one before it
  Eigen::VectorXd trial_;
  FixedPoint points_;  ///< combines one trial more than trains have losses
};

}  // namespace rheonet
