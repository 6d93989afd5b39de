#include "core/dae/free_motions.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/base/numerics.hpp"

namespace rheonet {

FreeMotions::FreeMotions(const Network& network, DisjointSets& sets)
    : network_(network), sets_(sets), placed_(network.nodes(), 0), geared_(placed_) {
  for (const Network::Train& train : network.trains) {
    for (const NodeId node : train.node) geared_[at(sets.find(node))] = 1;
  }
}

/// A basis of the motions of the geared sets that are not placed, one a column. `moving`: these sets.
Eigen::MatrixXd FreeMotions::motions(std::vector<NodeId>& moving) const {
  for (std::size_t n = 0; n < geared_.size(); ++n) {
    if (geared_[n] && !placed_[n]) moving.push_back(static_cast<NodeId>(n));
  }
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(network_.trains.size()), static_cast<Eigen::Index>(moving.size()));
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto set = std::find(moving.begin(), moving.end(), sets_.find(network_.trains[k].node[i]));
      if (set != moving.end()) equations(static_cast<Eigen::Index>(k), set - moving.begin()) += network_.trains[k].factor[i];
    }
  }
  Eigen::FullPivLU<Eigen::MatrixXd> factors(equations);
  factors.setThreshold(numerics::equal_given_values);
  return factors.kernel();  // a column of zeros if nothing is free
}

bool FreeMotions::free(NodeId node) const {
  const NodeId set = sets_.find(node);
  if (placed_[at(set)]) return false;
  if (!geared_[at(set)]) return true;
  std::vector<NodeId> moving;
  const Eigen::MatrixXd free = motions(moving);
  const Eigen::Index row = std::find(moving.begin(), moving.end(), set) - moving.begin();
  return free.row(row).lpNorm<Eigen::Infinity>() > numerics::equal_given_values * free.lpNorm<Eigen::Infinity>();
}

std::vector<std::pair<NodeId, double>> FreeMotions::motion(NodeId node) const {
  const NodeId set = sets_.find(node);
  if (!geared_[at(set)]) return {{set, 1}};
  std::vector<NodeId> moving;
  const Eigen::MatrixXd free = motions(moving);
  const Eigen::VectorXd own = free.row(std::find(moving.begin(), moving.end(), set) - moving.begin());
  const Eigen::VectorXd all = free * (own / own.squaredNorm());
  std::vector<std::pair<NodeId, double>> result;
  for (std::size_t k = 0; k < moving.size(); ++k) result.push_back({moving[k], all[static_cast<Eigen::Index>(k)]});
  return result;
}

}  // namespace rheonet
