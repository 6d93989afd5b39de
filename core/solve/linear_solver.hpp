#pragma once

#include <optional>
#include <vector>

#include "core/dae/matrix.hpp"
#include "core/dae/sparse_factors.hpp"
#include "core/solve/dense_factors.hpp"

namespace rheonet {

/// The direct solver of the linear equations of an integrator's step: KLU, or dense elimination for a few unknowns. The
/// matrix mixes newtons and metres a second. It is scaled so that pivots are comparable and independent of units: each
/// unknown counts in multiples of its tolerance, and each equation is divided by the sum of its coefficients. A row with a
/// single unknown is then chosen as the pivot of that unknown: a velocity at rest is exactly 0.
class LinearSolver {
 public:
  /// `tolerance` (of each unknown, > 0) is read at each factorisation.
  LinearSolver(const Pattern& pattern, bool sparse, const std::vector<double>& tolerance);

  /// Entries of the matrix in the order of the pattern. Fill in all of them before each `factorise`, which overwrites them.
  double* entries() { return values_.data(); }
  /// False if it is singular.
  [[nodiscard]] bool factorise();
  /// Solves in place.
  void solve(double* right);

 private:
  void scale();

  const Pattern& pattern_;
  const std::vector<double>& tolerance_;
  std::optional<SparseFactors> sparse_;
  DenseFactors dense_;  // empty if `sparse_` is used
  std::vector<double> values_;
  double first_growth_ = 1;  // growth of the coefficients when the pivots were chosen
  std::vector<double> row_scale_, column_scale_;
};

}  // namespace rheonet
