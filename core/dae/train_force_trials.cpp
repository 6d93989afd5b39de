#include "core/dae/train_force_trials.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

TrainForceTrials::TrainForceTrials(const Network& network, const Inputs& inputs, const std::vector<double>& first, double forces)
    : network_(&network), inputs_(&inputs), forces_(forces), trial_(Eigen::Map<const Eigen::VectorXd>(first.data(), static_cast<Eigen::Index>(first.size()))),
      points_(1 + static_cast<std::size_t>(std::count_if(network.trains.begin(), network.trains.end(), [](const Network::Train& train) { return train.loss.has_value(); }))) {}

bool TrainForceTrials::agree(const std::vector<double>& found, double forces) {
  Eigen::VectorXd miss = Eigen::VectorXd::Zero(trial_.size());
  double size = std::max(forces_, forces);
  for (Eigen::Index k = 0; k < trial_.size(); ++k) {
    if (!network_->trains[static_cast<std::size_t>(k)].loss) continue;
    const Loss& loss = inputs_->loss(static_cast<std::size_t>(k));
    const double force = found[static_cast<std::size_t>(k)];
    miss[k] = force - trial_[k];
    size = std::max({size, std::abs(force), std::abs(trial_[k]), loss.lost(1, force), loss.lost(-1, force)});
  }
  // Within round-off it ends after two trials without more digits. At a kink two trials miss by the same amount, one on each side: in one of them a gear sticks,
  // in the other it slips.
  const double off = miss.lpNorm<Eigen::Infinity>();
  const bool closer = off < off_, stalls = std::exchange(stalls_, !closer) && !closer;
  if (closer) off_ = off;
  if (off <= numerics::balance_roundoff * size && (off <= numerics::equation_roundoff * size || stalls)) return true;
  Eigen::VectorXd next = points_.next(trial_, trial_ + miss);
  if (count_++ == 0 && near_) next = trial_ * (1 + numerics::near_trial);
  trial_ = std::move(next);
  return false;
}

bool TrainForceTrials::endless() const { return count_ > (near_ ? numerics::near_loss_trials : numerics::loss_trials); }

std::vector<TrainForceTrials> TrainForceTrials::around(const Network& network, const Inputs& inputs, double forces) {
  std::vector<std::size_t> lossy;
  for (std::size_t k = 0; k < network.trains.size(); ++k) {
    if (network.trains[k].loss) lossy.push_back(k);
  }
  std::vector<TrainForceTrials> result;
  for (double size = numerics::largest_trial * forces; size > numerics::smallest_trial * forces; size /= 8) {
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> first(network.trains.size(), 0);
      for (const std::size_t k : lossy) first[k] = sign * size;
      const auto begin = [&] {
        result.emplace_back(network, inputs, first, forces).near_ = true;
      };
      begin();
      for (std::size_t i = 0; lossy.size() > 1 && i < lossy.size(); ++i) {
        first[lossy[i]] *= -1;
        begin();
        first[lossy[i]] *= -1;
      }
    }
  }
  return result;
}

}  // namespace rheonet
