#include "core/dae/sparse_factors.hpp"

#include <cmath>
#include <limits>

#include "core/base/numerics.hpp"

namespace rheonet {

SparseFactors::SparseFactors(const Pattern& pattern) : pattern_(pattern) {
  klu_defaults(&common_);
  common_.scale = 0;
  common_.tol = numerics::diagonal_pivot_share;
}

SparseFactors::~SparseFactors() {
  release();
  klu_free_symbolic(&symbolic_, &common_);
}

void SparseFactors::release() { klu_free_numeric(&numeric_, &common_); }

bool SparseFactors::factorise(double* values) {
  release();
  if (!symbolic_) symbolic_ = klu_analyze(pattern_.size, columns(), rows(), &common_);
  if (symbolic_) numeric_ = klu_factor(columns(), rows(), values, symbolic_, &common_);
  return numeric_ != nullptr;
}

bool SparseFactors::refactorise(double* values) {
  if (!numeric_ || !klu_refactor(columns(), rows(), values, symbolic_, numeric_, &common_)) return false;
  // A pivot may be small for its place alone, by its units: the estimated condition number decides.
  static const double small = std::pow(std::numeric_limits<double>::epsilon(), numerics::refactor_condition_exponent);
  klu_rcond(symbolic_, numeric_, &common_);
  if (common_.rcond >= small) return true;
  klu_condest(columns(), values, symbolic_, numeric_, &common_);
  return common_.condest <= 1 / small;
}

double SparseFactors::growth(double* values) {
  klu_rgrowth(columns(), rows(), values, symbolic_, numeric_, &common_);
  return 1 / common_.rgrowth;
}

void SparseFactors::solve(double* b) { klu_solve(symbolic_, numeric_, pattern_.size, 1, b, &common_); }

}  // namespace rheonet
