#include "core/solve/linear_solver.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

LinearSolver::LinearSolver(const Pattern& pattern, bool sparse, const std::vector<double>& tolerance)
    : pattern_(pattern),
      tolerance_(tolerance),
      dense_(sparse ? 0 : pattern.size),
      values_(at(pattern.entries())),
      row_scale_(at(pattern.size), 1),
      column_scale_(at(pattern.size), 1) {
  if (sparse) sparse_.emplace(pattern);
}

void LinearSolver::scale() {
  column_scale_ = tolerance_;
  std::fill(row_scale_.begin(), row_scale_.end(), 0.0);
  const auto for_each_entry = [&](auto visit) {
    for (int c = 0; c < pattern_.size; ++c) {
      for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) visit(pattern_.row[at(e)], c, values_[at(e)]);
    }
  };
  for_each_entry([&](int row, int column, double& value) {
    value *= column_scale_[at(column)];
    row_scale_[at(row)] += std::abs(value);
  });
  // A row of zeros stays for the factorisation to detect.
  for (double& s : row_scale_) s = s > 0 && std::isfinite(s) ? 1 / s : 1;
  for_each_entry([&](int row, int, double& value) { value *= row_scale_[at(row)]; });
  if (sparse_) return;
  double* matrix = dense_.matrix();
  std::fill_n(matrix, at(pattern_.size) * at(pattern_.size), 0.0);
  for_each_entry([&](int row, int column, double value) { matrix[at(column) * at(pattern_.size) + at(row)] = value; });
}

bool LinearSolver::factorise() {
  scale();
  if (!sparse_) return dense_.factorise();
  // A former pivot may have become 0 or almost so, such as the slope of friction at its bound: dividing by it leaves few
  // digits of other unknowns.
  if (sparse_->refactorise(values_.data()) && sparse_->growth(values_.data()) <= numerics::pivot_growth_ratio * first_growth_) return true;
  if (!sparse_->factorise(values_.data())) return false;
  first_growth_ = std::min(sparse_->growth(values_.data()), numerics::largest_pivot_growth);
  return true;
}

void LinearSolver::solve(double* right) {
  for (std::size_t i = 0; i < row_scale_.size(); ++i) right[i] *= row_scale_[i];
  if (sparse_) {
    sparse_->solve(right);
  } else {
    dense_.solve(right);
  }
  for (std::size_t i = 0; i < column_scale_.size(); ++i) right[i] *= column_scale_[i];
}

}  // namespace rheonet
