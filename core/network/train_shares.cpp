#include "core/network/train_shares.hpp"

#include <utility>

#include "core/base/index.hpp"
#include "core/network/network.hpp"

namespace rheonet {

TrainShares::TrainShares(const Network& network, const std::vector<Structure::TrainEquation>& equations, const std::vector<NodeId>& head, std::vector<NodeId> node)
    : nodes_(std::move(node)), trains_(static_cast<Eigen::Index>(equations.size())) {
  std::vector<Eigen::Index> place(head.size(), -1), pivot(head.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) place[at(nodes_[i])] = static_cast<Eigen::Index>(i);
  for (std::size_t r = 0; r < equations.size(); ++r) pivot[at(equations[r].pivot)] = static_cast<Eigen::Index>(r);
  for (std::size_t r = 0; r < equations.size(); ++r) {
    const std::size_t train = at(equations[r].train);
    for (std::size_t end = 0; end < 3; ++end) {
      const std::size_t n = at(head[at(network.trains[train].node[end])]);
      const auto column = static_cast<Eigen::Index>(r);
      if (place[n] >= 0) of_nodes_.push_back({train, end, place[n], column});
      if (pivot[n] >= 0) of_pivots_.push_back({train, end, pivot[n], column});
    }
  }
}

Eigen::MatrixXd TrainShares::fill(const std::vector<Place>& places, Eigen::Index rows, Eigen::Index columns, const std::vector<std::array<double, 3>>& train_forces) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns);
  for (const Place& p : places) result(p.row, p.column) += train_forces[p.train][p.end];
  return result;
}

const Eigen::MatrixXd& TrainShares::take(const std::vector<std::array<double, 3>>& train_forces) {
  pivots_.compute(fill(of_pivots_, trains_, trains_, train_forces).transpose());
  shares_ = pivots_.solve(fill(of_nodes_, static_cast<Eigen::Index>(nodes_.size()), trains_, train_forces).transpose()).transpose();
  return shares_;
}

Eigen::MatrixXd TrainShares::rate(const std::vector<std::array<double, 3>>& rates) const {
  const Eigen::MatrixXd right = fill(of_nodes_, shares_.rows(), trains_, rates) - shares_ * fill(of_pivots_, trains_, trains_, rates);
  return pivots_.solve(right.transpose()).transpose();
}

}  // namespace rheonet
