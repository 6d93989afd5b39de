#pragma once

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <vector>

#include "core/network/structure.hpp"

namespace rheonet {

/// Forces of the sliders that stick, from the balance of forces at the nodes that they join. Where they form loops, or
/// lead to several known nodes, the balance leaves forces open: then those of least sum of squares within the bounds.
class Bonds {
 public:
  Bonds(const Network& network, const Structure& structure);
  bool empty() const { return sliders_.empty(); }

  /// `left[n]` is the sum of all other forces at node n, inertia included [N]. Writes the forces of the sliders that stick.
  void solve(const std::vector<double>& left, std::vector<double>& force) const;

 private:
  struct Bond { std::size_t slider; NodeId a, b; double bound; };
  using Matrix = Eigen::SparseMatrix<double>;
  Matrix laplacian(const std::vector<char>& clamped) const;
  bool still_joined(const std::vector<char>& clamped) const;
  std::vector<Bond> sliders_;
  std::vector<int> row_;  ///< of each node: its potential's index, -1 for one whose balance is free or follows
  std::vector<NodeId> node_;  ///< of each row
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> laplacian_;
};

}  // namespace rheonet
