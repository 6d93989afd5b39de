#include "core/dae/slip_forces.hpp"

#include <algorithm>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

SlipForces::SlipForces(const Network& network, const Structure& structure, const Inputs& inputs)
    : network_(network),
      structure_(structure),
      inputs_(inputs),
      force_(network.sliders.size(), 0),
      side_(network.sliders.size(), 0),
      b_drives_(network.trains.size(), 0),
      loss_lines_(network.trains.size()),
      train_forces_(structure.train_forces),
      equations_(structure.train_equations) {
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    if (!structure.stuck[k] && !network.sliders[k].varying.empty()) varying_.push_back(k);
  }
  if (std::any_of(varying_.begin(), varying_.end(), [&](std::size_t k) { return network.sliders[k].train >= 0; }) && !equations_.empty()) {
    std::vector<NodeId> sharing;
    for (const auto& [node, share] : equations_.front().shares) sharing.push_back(node);
    train_shares_.emplace(network, equations_, structure.rigid, std::move(sharing));
  }
}

void SlipForces::enter(const Modes& modes) {
  b_drives_ = modes.b_drives;
  for (std::size_t k = 0; k < force_.size(); ++k) {
    side_[k] = structure_.stuck[k] ? static_cast<signed char>(Modes::stuck) : modes.slider[k];
    force_[k] = side_[k] == 0 ? 0 : side_[k] * inputs_.box(k).at(side_[k]).sliding.value;
  }
  follow_losses();
}

void SlipForces::follow() {
  for (const std::size_t k : varying_) force_[k] = side_[k] * inputs_.box(k).at(side_[k]).sliding.value;
  if (train_shares_) follow_losses();
}

/// The forces of trains at their nodes, with the losses that slip, at their present speeds.
void SlipForces::follow_losses() {
  for (std::size_t k = 0; k < force_.size(); ++k) {
    const int train = network_.sliders[k].train;
    if (train < 0 || side_[k] == 0) continue;
    const Loss::Line line = loss_lines_[at(train)] = inputs_.loss(at(train)).line(side_[k], b_drives_[at(train)] != 0);
    force_[k] = line.offset;
    train_forces_[at(train)] = network_.trains[at(train)].factor;
    train_forces_[at(train)][0] += line.factor - 1;
    train_forces_[at(train)][2] -= line.factor - 1;
  }
  if (!train_shares_) return;
  const Eigen::MatrixXd& shares = train_shares_->take(train_forces_);
  for (std::size_t r = 0; r < equations_.size(); ++r) {
    for (std::size_t i = 0; i < equations_[r].shares.size(); ++i) {
      equations_[r].shares[i].factor = shares(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(r));
    }
  }
}

double SlipForces::slope(std::size_t k, std::size_t parameter) const {
  const int train = network_.sliders[k].train;
  return train < 0 ? side_[k] * inputs_.sliding_slope(k, side_[k], parameter) : inputs_.loss_slope(k, side_[k], b_drives_[at(train)] != 0, parameter).offset;
}

Eigen::MatrixXd SlipForces::share_slopes(std::size_t k, std::size_t parameter) const {
  const std::size_t train = at(network_.sliders[k].train);
  const double factor = inputs_.loss_slope(k, side_[k], b_drives_[train] != 0, parameter).factor;
  std::vector<std::array<double, 3>> rates(train_forces_.size());
  rates[train] = {factor, 0, -factor};
  return train_shares_->rate(rates);
}

}  // namespace rheonet
