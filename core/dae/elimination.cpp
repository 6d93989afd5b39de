#include "core/dae/elimination.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/dae/sparse_factors.hpp"
#include "core/network/index.hpp"

namespace rheonet {

namespace {

constexpr int dense_limit = 40;  // above this many unknowns sparse elimination wins

}  // namespace

struct Elimination::Factor {
  explicit Factor(const Pattern& pattern) : dense(pattern.size <= dense_limit), sparse(pattern), row_scale(pattern.size) {}
  bool dense;
  Eigen::MatrixXd matrix;
  Eigen::FullPivLU<Eigen::MatrixXd> lu;
  SparseFactors sparse;
  Eigen::VectorXd row_scale;
};

Elimination::Elimination(const Pattern& pattern) : pattern_(pattern), factor_(std::make_unique<Factor>(pattern)) {}

Elimination::~Elimination() = default;

bool Elimination::factorise(const std::vector<double>& values) {
  if (!scale_rows(values)) return false;
  return factor_->dense ? factorise_dense(values) : factorise_sparse(values);
}

/// Rows hold newtons or metres a second: each is divided by its largest entry, so that pivots can be compared.
bool Elimination::scale_rows(const std::vector<double>& values) {
  Eigen::VectorXd& scale = factor_->row_scale;
  scale.setZero();
  for (std::size_t e = 0; e < values.size(); ++e) {
    double& s = scale[pattern_.row[e]];
    s = std::max(s, std::abs(values[e]));
  }
  for (int r = 0; r < pattern_.size; ++r) {
    if (!(scale[r] > 0) || !std::isfinite(scale[r])) return false;
    scale[r] = 1 / scale[r];
  }
  return true;
}

bool Elimination::factorise_dense(const std::vector<double>& values) {
  Factor& f = *factor_;
  f.matrix.setZero(pattern_.size, pattern_.size);
  for (int c = 0; c < pattern_.size; ++c) {
    for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) {
      const int r = pattern_.row[at(e)];
      f.matrix(r, c) = values[at(e)] * f.row_scale[r];
    }
  }
  f.lu.setThreshold(1e-290);  // only an exact zero is singular: stiffness ratios of 1e12 are not
  f.lu.compute(f.matrix);
  return f.lu.isInvertible();
}

bool Elimination::factorise_sparse(const std::vector<double>& values) {
  std::vector<double> scaled(values);
  for (std::size_t e = 0; e < values.size(); ++e) scaled[e] *= factor_->row_scale[pattern_.row[e]];
  return factor_->sparse.factorise(scaled.data());
}

void Elimination::release() { factor_->sparse.release(); }

double Elimination::scaled(int row, double right) const { return right * factor_->row_scale[row]; }

void Elimination::solve(std::vector<double>& b) const {
  Eigen::Map<Eigen::VectorXd> x(b.data(), static_cast<Eigen::Index>(b.size()));
  x.array() *= factor_->row_scale.array();
  if (factor_->dense) {
    x = factor_->lu.solve(x).eval();
  } else {
    factor_->sparse.solve(b.data());
  }
}

}  // namespace rheonet
