#pragma once

#include <klu.h>

#include "core/dae/matrix.hpp"

namespace rheonet {

/// Triangular factors of a sparse matrix. KLU, of T. A. Davis and E. Palamadai Natarajan, ACM Transactions on Mathematical
/// Software 37 (2010) 36: it finds blocks that can be solved one after the other; each integrated unknown is such a block. Rows
/// and columns should have been scaled: entries are compared to choose pivots.
class SparseFactors {
 public:
  /// The pattern must outlive this.
  explicit SparseFactors(const Pattern& pattern);
  ~SparseFactors();
  SparseFactors(const SparseFactors&) = delete;
  SparseFactors& operator=(const SparseFactors&) = delete;

  /// Chooses pivots for a matrix with these values, in the order of the pattern. False if it is singular.
  [[nodiscard]] bool factorise(double* values);
  /// Factorises with the pivots chosen last. False if they are unsuitable.
  [[nodiscard]] bool refactorise(double* values);
  /// Growth of the coefficients in the last factorisation, of a matrix with these values.
  double growth(double* values);
  /// Solves A x = b; x takes the place of b.
  void solve(double* b);
  /// Frees the memory of the factors, but keeps the order of elimination.
  void release();

 private:
  // KLU does not change these arrays.
  int* columns() const { return const_cast<int*>(pattern_.column_start.data()); }
  int* rows() const { return const_cast<int*>(pattern_.row.data()); }

  const Pattern& pattern_;
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace rheonet
