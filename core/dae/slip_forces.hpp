#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/inputs.hpp"
#include "core/network/structure.hpp"
#include "core/network/train_shares.hpp"

namespace rheonet {

/// Forces of the sliders that slip, and the equations of the trains whose losses slip with them, under the inputs last evaluated.
class SlipForces {
 public:
  /// All must outlive this.
  SlipForces(const Network& network, const Structure& structure, const Inputs& inputs);

  /// Sliders slip in the directions of `modes` from here on.
  void enter(const Modes& modes);
  /// Follows the inputs, and the speeds on which losses depend.
  void follow();

  /// For each slider: its force [N], 0 while it sticks. A slider that stands for losses has the part without the force of the train.
  const std::vector<double>& force() const { return force_; }
  /// Its force if that of its train, if any, is this [N].
  double force(std::size_t slider, const std::vector<double>& train_force) const {
    const int train = network_.sliders[slider].train;
    return train < 0 ? force_[slider] : loss_lines_[at(train)].at(train_force[at(train)]) - train_force[at(train)];
  }
  /// The direction in which it slips; 0 while it sticks.
  int side(std::size_t slider) const { return side_[slider]; }
  /// Slipping sliders whose sliding force varies.
  const std::vector<std::size_t>& varying() const { return varying_; }
  /// Derivative of the force of such a slider by one of its varying parameters.
  double slope(std::size_t slider, std::size_t parameter) const;

  /// For each train: factors of its force in the balances of its nodes, as in Structure, with the present losses.
  const std::vector<std::array<double, 3>>& train_forces() const { return train_forces_; }
  /// Equations of the trains, with the present shares.
  const std::vector<Structure::TrainEquation>& equations() const { return equations_; }
  /// Some losses depend on the speed: factors and shares change between events.
  bool shares_vary() const { return train_shares_.has_value(); }
  /// Derivatives of the shares by a varying parameter of a slider that stands for losses.
  Eigen::MatrixXd share_slopes(std::size_t slider, std::size_t parameter) const;

 private:
  void follow_losses();

  const Network& network_;
  const Structure& structure_;
  const Inputs& inputs_;
  std::vector<double> force_;
  std::vector<signed char> side_;
  std::vector<std::size_t> varying_;
  std::vector<char> b_drives_;                ///< For each train.
  std::optional<TrainShares> train_shares_;   ///< If some depend on the speed.
  std::vector<Loss::Line> loss_lines_;        ///< For each train whose losses slip.
  std::vector<std::array<double, 3>> train_forces_;
  std::vector<Structure::TrainEquation> equations_;
};

}  // namespace rheonet
