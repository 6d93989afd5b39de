#pragma once

#include <vector>

namespace rheonet {

/// A dense matrix in triangular factors, with pivots from each column: for a few unknowns.
class DenseFactors {
 public:
  explicit DenseFactors(int size);

  /// The matrix by columns, all of it to be filled in before it is factorised.
  double* matrix() { return a_.data(); }
  /// False if it is singular.
  [[nodiscard]] bool factorise();
  /// In place.
  void solve(double* right) const;

 private:
  int size_;
  std::vector<double> a_;
  std::vector<int> pivot_;  ///< the row that each one has been exchanged with
};

}  // namespace rheonet
