#include "core/solve/dense_factors.hpp"

#include <cmath>
#include <utility>

#include "core/network/index.hpp"

namespace rheonet {

DenseFactors::DenseFactors(int size) : size_(size), a_(at(size) * at(size)), pivot_(at(size)) {}

bool DenseFactors::factorise() {
  const int n = size_;
  for (int k = 0; k < n; ++k) {
    double* column = &a_[at(k) * at(n)];
    int best = k;
    for (int i = k + 1; i < n; ++i) {
      if (std::abs(column[i]) > std::abs(column[best])) best = i;
    }
    pivot_[at(k)] = best;
    if (column[best] == 0) return false;
    if (best != k) {
      for (int j = 0; j < n; ++j) std::swap(a_[at(j) * at(n) + at(k)], a_[at(j) * at(n) + at(best)]);
    }
    const double inverse = 1 / column[k];
    for (int i = k + 1; i < n; ++i) column[i] *= inverse;
    for (int j = k + 1; j < n; ++j) {
      double* other = &a_[at(j) * at(n)];
      for (int i = k + 1; i < n && other[k] != 0; ++i) other[i] -= other[k] * column[i];
    }
  }
  return true;
}

void DenseFactors::solve(double* right) const {
  const int n = size_;
  for (int k = 0; k < n; ++k) std::swap(right[k], right[pivot_[at(k)]]);
  for (int k = 0; k < n; ++k) {
    for (int i = k + 1; i < n; ++i) right[i] -= right[k] * a_[at(k) * at(n) + at(i)];
  }
  for (int k = n - 1; k >= 0; --k) {
    right[k] /= a_[at(k) * at(n) + at(k)];
    for (int i = 0; i < k; ++i) right[i] -= right[k] * a_[at(k) * at(n) + at(i)];
  }
}

}  // namespace rheonet
