#pragma once

#include <Eigen/LU>

namespace rheonet {

/// A dense matrix in triangular factors, with pivots from each column: for a few unknowns.
class DenseFactors {
 public:
  explicit DenseFactors(int size) : matrix_(size, size) {}

  /// The matrix by columns, all of it to be filled in before it is factorised.
  double* matrix() { return matrix_.data(); }
  /// False if it is singular.
  [[nodiscard]] bool factorise() {
    factors_.compute(matrix_);
    return (factors_.matrixLU().diagonal().array() != 0).all();
  }
  /// In place.
  void solve(double* right) const {
    Eigen::Map<Eigen::VectorXd> x(right, matrix_.rows());
    x = factors_.solve(x);
  }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
};

}  // namespace rheonet
