#include "core/solve/linear_solver.hpp"

#include <sundials/sundials_nvector.h>

#include <algorithm>
#include <cmath>

#include "core/network/index.hpp"

namespace rheonet {

namespace {

// So much more than with pivots that are chosen for a matrix its coefficients may grow with those of an earlier one.
constexpr double much_more = 1e3;
// What is larger than that says that there are no better ones.
constexpr double most = 1e6;

}  // namespace

LinearSolver::LinearSolver(const Pattern& pattern, bool sparse, const std::vector<double>& tolerance, SUNContext context)
    : pattern_(pattern),
      tolerance_(tolerance),
      dense_(sparse ? 0 : pattern.size),
      values_(at(pattern.entries())),
      row_scale_(at(pattern.size), 1),
      column_scale_(at(pattern.size), 1) {
  if (sparse) sparse_.emplace(pattern);
  // IDA asks for a matrix even where it is left alone with it.
  matrix_ = SUNMatNewEmpty(context);
  matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix_->ops->destroy = SUNMatFreeEmpty;
  // All of it is filled in anew.
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  outer_ = SUNLinSolNewEmpty(context);
  outer_->content = this;
  outer_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  outer_->ops->setup = [](SUNLinearSolver s, SUNMatrix) { return of(s).setup(); };
  outer_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype) { return of(s).solve(x, b); };
}

LinearSolver::~LinearSolver() {
  SUNLinSolFreeEmpty(outer_);
  SUNMatDestroy(matrix_);
}

void LinearSolver::filled() {
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
  // A row of zeros is left for the solver to find.
  for (double& s : row_scale_) s = s > 0 && std::isfinite(s) ? 1 / s : 1;
  for_each_entry([&](int row, int, double& value) { value *= row_scale_[at(row)]; });
  if (sparse_) return;
  double* matrix = dense_.matrix();
  std::fill_n(matrix, at(pattern_.size) * at(pattern_.size), 0.0);
  for_each_entry([&](int row, int column, double value) { matrix[at(column) * at(pattern_.size) + at(row)] = value; });
}

int LinearSolver::setup() {
  if (!sparse_) return dense_.factorise() ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
  // What was a pivot may since have come to 0, friction's slope at its bound for one, or near it: what is divided by that leaves
  // few digits of others.
  if (sparse_->refactorise(values_.data()) && sparse_->growth(values_.data()) <= much_more * first_growth_) return SUNLS_SUCCESS;
  if (!sparse_->factorise(values_.data())) return SUNLS_PACKAGE_FAIL_REC;
  first_growth_ = std::min(sparse_->growth(values_.data()), most);
  return SUNLS_SUCCESS;
}

int LinearSolver::solve(N_Vector x, N_Vector b) {
  const double* right = N_VGetArrayPointer(b);
  double* left = N_VGetArrayPointer(x);
  for (std::size_t i = 0; i < row_scale_.size(); ++i) left[i] = right[i] * row_scale_[i];
  if (sparse_) {
    sparse_->solve(left);
  } else {
    dense_.solve(left);
  }
  for (std::size_t i = 0; i < column_scale_.size(); ++i) left[i] *= column_scale_[i];
  return SUNLS_SUCCESS;
}

}  // namespace rheonet
