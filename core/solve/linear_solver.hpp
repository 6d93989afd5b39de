#pragma once

#include <optional>
#include <vector>

#include "core/dae/matrix.hpp"
#include "core/dae/sparse_factors.hpp"
#include "core/solve/dense_factors.hpp"

namespace rheonet {

/// The direct solver of the linear equations of an integrator's step: KLU, or dense elimination for a few unknowns. Newtons
/// stand beside metres a second in the matrix: so that pivots can be compared, and so that they are the same in whatever
/// units, each unknown counts in multiples of its tolerance, and each equation is divided by the sum of its coefficients. An
/// equation for a single unknown is then the pivot of that: what rests has a velocity of 0 exactly.
class LinearSolver {
 public:
  /// `tolerance` (of each unknown, > 0) is read whenever there is a new matrix.
  LinearSolver(const Pattern& pattern, bool sparse, const std::vector<double>& tolerance);

  /// Entries of the matrix in the order of the pattern: to be filled in anew before it is factorised.
  double* entries() { return values_.data(); }
  /// False if it is singular.
  [[nodiscard]] bool factorise();
  /// In place.
  void solve(double* right);

 private:
  void scale();

  const Pattern& pattern_;
  const std::vector<double>& tolerance_;
  std::optional<SparseFactors> sparse_;
  DenseFactors dense_;  // of no unknowns if there are sparse ones
  std::vector<double> values_;
  double first_growth_ = 1;  // with pivots that were chosen for that matrix
  std::vector<double> row_scale_, column_scale_;
};

}  // namespace rheonet
