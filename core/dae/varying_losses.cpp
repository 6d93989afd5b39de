#include "core/dae/dae.hpp"

namespace rheonet {

/// The forces of trains at their nodes, with the losses that slip, at their present speeds.
void Dae::follow_losses() {
  for (std::size_t k = 0; k < slip_force_.size(); ++k) {
    const int train = network_->sliders[k].train;
    if (train < 0 || slip_side_[k] == 0) continue;
    const Loss::Line line = loss_lines_[at(train)] = inputs_->loss(at(train)).line(slip_side_[k], b_drives_[at(train)] != 0);
    slip_force_[k] = line.offset;
    train_forces_[at(train)] = network_->trains[at(train)].factor;
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

/// Entries of the shares that nodes have of the balances of pivots.
void Dae::couple_shares(PatternBuilder& builder) {
  for (const std::size_t k : varying_) {
    if (network_->sliders[k].train < 0) continue;
    for (std::size_t i = 0; i < network_->sliders[k].varying.size(); ++i) {
      const auto block = at(network_->sliders[k].varying[i].block);
      for (std::size_t r = 0; r < equations_.size(); ++r) {
        for (std::size_t s = 0; s < equations_[r].shares.size(); ++s) {
          for (const Coupling& entry : entries_of(builder, index_.velocity[at(equations_[r].shares[s].node)], false, block, 1)) {
            share_couplings_.push_back({entry, k, i, static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(r)});
          }
        }
      }
    }
  }
}

/// A row that has a share S of the balance r of a pivot is less S r: its derivative has the part -dS r. The entries of one parameter
/// follow each other.
void Dae::shares_jacobian(const double* yp, double* values) {
  if (share_couplings_.empty() || !yp) return;
  sum_forces();
  std::vector<double> balance(at(size()));
  balances(yp, balance.data());
  std::vector<std::array<double, 3>> rates(train_forces_.size());
  Eigen::MatrixXd rate;
  const ShareCoupling* last = nullptr;
  for (const ShareCoupling& c : share_couplings_) {
    if (!last || last->slider != c.slider || last->parameter != c.parameter) {
      const std::size_t train = at(network_->sliders[c.slider].train);
      const double factor = inputs_->loss_slope(c.slider, slip_side_[c.slider], b_drives_[train] != 0, c.parameter).factor;
      rates.assign(rates.size(), {});
      rates[train] = {factor, 0, -factor};
      rate = train_shares_->rate(rates);
      last = &c;
    }
    values[c.coupling.entry] -= balance[at(index_.velocity[at(equations_[static_cast<std::size_t>(c.pivot)].pivot)])] * rate(c.share, c.pivot) * slope(c.coupling);
  }
}

}  // namespace rheonet
