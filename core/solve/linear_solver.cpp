#include "core/solve/linear_solver.hpp"

#include <klu.h>
#include <sundials/sundials_nvector.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>

#include "core/network/index.hpp"

namespace rheonet {

namespace {

// So much more than with pivots that are chosen for a matrix its coefficients may grow with those of an earlier one.
constexpr double much_more = 1e3;
// What is larger than that says that there are no better ones.
constexpr double most = 1e6;
// A pivot off the diagonal is taken where that is smaller than this share of the largest of its column. (KLU's 1e-3 costs three
// digits of what is stiff.)
constexpr double pivot_share = 0.1;

}  // namespace

LinearSolver::LinearSolver(const Pattern& pattern, bool sparse, const std::vector<double>& tolerance, N_Vector like,
                           SUNContext context)
    : pattern_(pattern),
      tolerance_(tolerance),
      sparse_(sparse),
      dense_(sparse ? 0 : pattern.size),
      row_scale_(at(pattern.size), 1),
      column_scale_(at(pattern.size), 1) {
  const sunindextype n = pattern.size;
  if (sparse) {
    matrix_ = SUNSparseMatrix(n, n, pattern.entries(), CSC_MAT, context);
    inner_ = SUNLinSol_KLU(like, matrix_, context);
    SUNLinSol_KLUGetCommon(inner_)->scale = 0;
    SUNLinSol_KLUGetCommon(inner_)->tol = pivot_share;
  } else {
    values_.resize(at(pattern.entries()));
    matrix_ = SUNMatNewEmpty(context);
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix_->ops->destroy = SUNMatFreeEmpty;
  }
  // All of it is filled in anew.
  matrix_->ops->zero = [](SUNMatrix) { return 0; };
  outer_ = SUNLinSolNewEmpty(context);
  outer_->content = this;
  outer_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  outer_->ops->initialize = [](SUNLinearSolver s) { return of(s).sparse_ ? SUNLinSolInitialize(of(s).inner_) : SUNLS_SUCCESS; };
  outer_->ops->setup = [](SUNLinearSolver s, SUNMatrix) { return of(s).setup(); };
  outer_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, realtype tolerance) {
    return of(s).solve(x, b, tolerance);
  };
}

LinearSolver::~LinearSolver() {
  SUNLinSolFreeEmpty(outer_);
  if (sparse_) SUNLinSolFree(inner_);
  SUNMatDestroy(matrix_);
}

double* LinearSolver::entries() {
  if (!sparse_) return values_.data();
  std::copy(pattern_.column_start.begin(), pattern_.column_start.end(), SUNSparseMatrix_IndexPointers(matrix_));
  std::copy(pattern_.row.begin(), pattern_.row.end(), SUNSparseMatrix_IndexValues(matrix_));
  return SUNSparseMatrix_Data(matrix_);
}

void LinearSolver::filled() {
  double* values = sparse_ ? SUNSparseMatrix_Data(matrix_) : values_.data();
  column_scale_ = tolerance_;
  std::fill(row_scale_.begin(), row_scale_.end(), 0.0);
  const auto for_each_entry = [&](auto visit) {
    for (int c = 0; c < pattern_.size; ++c) {
      for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) visit(pattern_.row[at(e)], c, values[e]);
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
  const int flag = SUNLinSolSetup(inner_, matrix_);
  // KLU keeps the pivots that it chose first. What was one may since have come to 0, friction's slope at its bound for one, or
  // near it: what is divided by that leaves few digits of others.
  if (flag == SUNLS_SUCCESS && pivot_growth() <= much_more * first_growth_) return flag;
  if (flag != SUNLS_SUCCESS && flag != SUNLS_PACKAGE_FAIL_REC) return flag;
  if (SUNLinSol_KLUReInit(inner_, matrix_, SUNSparseMatrix_NNZ(matrix_), SUNKLU_REINIT_PARTIAL) != SUNLS_SUCCESS) return flag;
  if (SUNLinSolSetup(inner_, matrix_) != SUNLS_SUCCESS) return SUNLS_PACKAGE_FAIL_REC;
  first_growth_ = std::min(pivot_growth(), most);
  return SUNLS_SUCCESS;
}

double LinearSolver::pivot_growth() const {
  klu_l_common* common = SUNLinSol_KLUGetCommon(inner_);
  klu_l_rgrowth(SUNSparseMatrix_IndexPointers(matrix_), SUNSparseMatrix_IndexValues(matrix_), SUNSparseMatrix_Data(matrix_),
                SUNLinSol_KLUGetSymbolic(inner_), SUNLinSol_KLUGetNumeric(inner_), common);
  return 1 / common->rgrowth;
}

int LinearSolver::solve(N_Vector x, N_Vector b, double tolerance) const {
  double *right = N_VGetArrayPointer(b), *left = N_VGetArrayPointer(x);
  for (std::size_t i = 0; i < row_scale_.size(); ++i) right[i] *= row_scale_[i];
  int flag = SUNLS_SUCCESS;
  if (sparse_) {
    flag = SUNLinSolSolve(inner_, matrix_, x, b, tolerance);
  } else {
    std::copy_n(right, row_scale_.size(), left);
    dense_.solve(left);
  }
  for (std::size_t i = 0; i < column_scale_.size(); ++i) left[i] *= column_scale_[i];
  return flag;
}

}  // namespace rheonet
