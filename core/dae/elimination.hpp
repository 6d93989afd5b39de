#pragma once

#include <memory>
#include <vector>

#include "core/dae/matrix.hpp"

namespace rheonet {

/// Gaussian elimination with matrices of one sparsity pattern, dense where that is quicker.
class Elimination {
 public:
  /// The pattern must outlive this.
  explicit Elimination(const Pattern& pattern);
  ~Elimination();

  /// Factorises the matrix with these values, in the order of the pattern. False if it is singular.
  [[nodiscard]] bool factorise(const std::vector<double>& values);
  /// The right side of a row as it is eliminated: divided by the largest entry of the row.
  double scaled(int row, double right) const;
  /// Solves A x = b with the matrix last factorised; x takes the place of b.
  void solve(std::vector<double>& b) const;
  /// Frees the memory of large factors until the next matrix.
  void release();

 private:
  struct Factor;
  bool scale(const std::vector<double>& values);
  bool factorise_dense(const std::vector<double>& values);
  bool factorise_sparse(const std::vector<double>& values);

  const Pattern& pattern_;
  std::vector<double> factorised_;  ///< Values of the matrix that is factorised; empty if none is. Between two events those of a linear network stay.
  std::unique_ptr<Factor> factor_;
};

}  // namespace rheonet
