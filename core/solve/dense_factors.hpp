#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace rheonet {

/// LU factors of a dense matrix, with partial (column) pivoting: for a few unknowns, where calls of a library cost more
/// than the elimination.
class DenseFactors {
 public:
  explicit DenseFactors(int size) : size_(static_cast<std::size_t>(size)), matrix_(size_ * size_), pivot_(size_) {}

  /// The matrix by columns. Fill in every entry before `factorise`, which overwrites them.
  double* matrix() { return matrix_.data(); }

  /// False if it is singular.
  [[nodiscard]] bool factorise() {
    for (std::size_t k = 0; k < size_; ++k) {
      double* of_pivot = column(k);
      std::size_t p = k;
      for (std::size_t i = k + 1; i < size_; ++i) {
        if (std::abs(of_pivot[i]) > std::abs(of_pivot[p])) p = i;
      }
      if (of_pivot[p] == 0) return false;
      pivot_[k] = p;
      for (std::size_t j = k; j < size_ && p != k; ++j) std::swap(column(j)[k], column(j)[p]);
      for (std::size_t i = k + 1; i < size_; ++i) of_pivot[i] /= of_pivot[k];
      for (std::size_t j = k + 1; j < size_; ++j) {
        for (std::size_t i = k + 1; i < size_; ++i) column(j)[i] -= of_pivot[i] * column(j)[k];
      }
    }
    return true;
  }

  /// Solves in place.
  void solve(double* x) const {
    for (std::size_t k = 0; k < size_; ++k) {
      std::swap(x[k], x[pivot_[k]]);
      for (std::size_t i = k + 1; i < size_; ++i) x[i] -= column(k)[i] * x[k];
    }
    for (std::size_t k = size_; k-- > 0;) {
      x[k] /= column(k)[k];
      for (std::size_t i = 0; i < k; ++i) x[i] -= column(k)[i] * x[k];
    }
  }

 private:
  double* column(std::size_t k) { return matrix_.data() + k * size_; }
  const double* column(std::size_t k) const { return matrix_.data() + k * size_; }

  std::size_t size_;
  std::vector<double> matrix_;
  std::vector<std::size_t> pivot_;  ///< of each column: the row that was swapped with its diagonal row
};

}  // namespace rheonet
