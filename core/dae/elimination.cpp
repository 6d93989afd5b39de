#include "core/dae/elimination.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/dae/sparse_factors.hpp"

namespace rheonet {

struct Elimination::Factor {
  explicit Factor(const Pattern& pattern) : dense(pattern.size <= numerics::dense_elimination_limit), sparse(pattern), row_scale(pattern.size), column_scale(pattern.size) {}
  bool dense;
  Eigen::MatrixXd matrix;
  Eigen::FullPivLU<Eigen::MatrixXd> lu;
  SparseFactors sparse;
  Eigen::VectorXd row_scale, column_scale;
};

Elimination::Elimination(const Pattern& pattern) : pattern_(pattern), factor_(std::make_unique<Factor>(pattern)) {}

Elimination::~Elimination() = default;

bool Elimination::factorise(const std::vector<double>& values) {
  if (values == factorised_) return true;
  factorised_.clear();
  if (!scale(values) || !(factor_->dense ? factorise_dense(values) : factorise_sparse(values))) return false;
  factorised_ = values;
  return true;
}

/// Rows and unknowns have different units (N, m/s): each row is divided by its largest entry, and then each column, so that
/// pivots can be compared.
bool Elimination::scale(const std::vector<double>& values) {
  Factor& f = *factor_;
  f.row_scale.setZero();
  f.column_scale.setZero();
  const auto find = [&](Eigen::VectorXd& largest, auto place, auto size) {
    for (int c = 0; c < pattern_.size; ++c) {
      for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) {
        const int r = pattern_.row[at(e)];
        largest[place(r, c)] = std::max(largest[place(r, c)], size(r, values[at(e)]));
      }
    }
    if (!(largest.minCoeff() > 0) || !std::isfinite(largest.maxCoeff())) return false;
    largest = largest.cwiseInverse();
    return true;
  };
  return find(f.row_scale, [](int row, int) { return row; }, [](int, double value) { return std::abs(value); }) &&
         find(f.column_scale, [](int, int column) { return column; }, [&](int row, double value) { return std::abs(value) * f.row_scale[row]; });
}

bool Elimination::factorise_dense(const std::vector<double>& values) {
  Factor& f = *factor_;
  f.matrix.setZero(pattern_.size, pattern_.size);
  for (int c = 0; c < pattern_.size; ++c) {
    for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) {
      const int r = pattern_.row[at(e)];
      f.matrix(r, c) = values[at(e)] * f.row_scale[r] * f.column_scale[c];
    }
  }
  f.lu.setThreshold(numerics::zero_pivot);
  f.lu.compute(f.matrix);
  return f.lu.isInvertible();
}

bool Elimination::factorise_sparse(const std::vector<double>& values) {
  std::vector<double> scaled(values);
  for (int c = 0; c < pattern_.size; ++c) {
    for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) {
      scaled[at(e)] *= factor_->row_scale[pattern_.row[at(e)]] * factor_->column_scale[c];
    }
  }
  return factor_->sparse.factorise(scaled.data());
}

void Elimination::release() {
  factor_->sparse.release();
  std::vector<double>().swap(factorised_);
}

double Elimination::scaled(int row, double right) const { return right * factor_->row_scale[row]; }

void Elimination::solve(std::vector<double>& b) const {
  Eigen::Map<Eigen::VectorXd> x(b.data(), static_cast<Eigen::Index>(b.size()));
  x.array() *= factor_->row_scale.array();
  if (factor_->dense) {
    x = factor_->lu.solve(x).eval();
  } else {
    factor_->sparse.solve(b.data());
  }
  x.array() *= factor_->column_scale.array();
}

}  // namespace rheonet
