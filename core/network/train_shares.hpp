#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Shares of the balances of pivots (Structure::Tied) that other nodes get. The balances of the pivots determine the forces of the
/// trains: with P the forces of the trains at the pivots and N those at the other nodes, the shares are N P^-1.
class TrainShares {
 public:
  /// `node`: those that get shares, and `head`: of each node the one that stands for it (Structure::rigid).
  TrainShares(const Network& network, const std::vector<Structure::Tied>& tied, const std::vector<NodeId>& head, std::vector<NodeId> node);

  /// One row for each node, one column for each pivot, where the trains have these forces at their nodes (Structure::train_forces).
  Eigen::MatrixXd at(const std::vector<std::array<double, 3>>& train_forces) const;
  /// Their rate where these forces have these rates. `shares`: those at these forces.
  Eigen::MatrixXd rate(const Eigen::MatrixXd& shares, const std::vector<std::array<double, 3>>& train_forces,
                       const std::vector<std::array<double, 3>>& rates) const;

  const std::vector<NodeId>& nodes() const { return nodes_; }

 private:
  struct Place { std::size_t train, end; Eigen::Index row, column; };  ///< a node of a train in a matrix
  static Eigen::MatrixXd fill(const std::vector<Place>& places, Eigen::Index rows, Eigen::Index columns, const std::vector<std::array<double, 3>>& train_forces);

  std::vector<NodeId> nodes_;
  Eigen::Index trains_;
  std::vector<Place> of_nodes_, of_pivots_;
};

}  // namespace rheonet
