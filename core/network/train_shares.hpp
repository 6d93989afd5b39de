#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Shares of the balances of pivots (Structure::TrainEquation) that other nodes get. The balances of the pivots determine the forces of the
/// trains: with P the forces of the trains at the pivots and N those at the other nodes, the shares are N P^-1.
class TrainShares {
 public:
  /// `node`: those that get shares, and `head`: of each node the one that stands for it (Structure::rigid).
  TrainShares(const Network& network, const std::vector<Structure::TrainEquation>& equations, const std::vector<NodeId>& head, std::vector<NodeId> node);

  /// Takes the present forces of the trains at their nodes (Structure::train_forces), and gives the shares: one row for each node, one
  /// column for each pivot.
  const Eigen::MatrixXd& take(const std::vector<std::array<double, 3>>& train_forces);
  /// The rate of the shares where the forces last taken have these rates.
  Eigen::MatrixXd rate(const std::vector<std::array<double, 3>>& rates) const;

  const std::vector<NodeId>& nodes() const { return nodes_; }

 private:
  struct Place { std::size_t train, end; Eigen::Index row, column; };  ///< a node of a train in a matrix
  static Eigen::MatrixXd fill(const std::vector<Place>& places, Eigen::Index rows, Eigen::Index columns, const std::vector<std::array<double, 3>>& train_forces);

  std::vector<NodeId> nodes_;
  Eigen::Index trains_;
  std::vector<Place> of_nodes_, of_pivots_;
  Eigen::FullPivLU<Eigen::MatrixXd> pivots_;  ///< of P, transposed
  Eigen::MatrixXd shares_;
};

}  // namespace rheonet
