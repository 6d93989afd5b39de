#include "core/dae/elimination.hpp"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include "core/network/index.hpp"

namespace rheonet {

namespace {

constexpr int dense_limit = 40;  // above this many unknowns sparse elimination wins

}  // namespace

struct Elimination::Factor {
  bool dense = true;
  Eigen::MatrixXd matrix;
  Eigen::FullPivLU<Eigen::MatrixXd> lu;
  Eigen::SparseMatrix<double> sparse;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> sparse_lu;
  bool analysed = false;
  Eigen::VectorXd row_scale;
};

Elimination::Elimination(const Pattern& pattern) : pattern_(pattern), factor_(std::make_unique<Factor>()) {
  factor_->dense = pattern.size <= dense_limit;
  factor_->row_scale.resize(pattern.size);
}

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
  Factor& f = *factor_;
  if (!f.analysed) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int c = 0; c < pattern_.size; ++c) {
      for (int e = pattern_.column_start[at(c)]; e < pattern_.column_start[at(c) + 1]; ++e) {
        entries.emplace_back(pattern_.row[at(e)], c, 1.0);
      }
    }
    f.sparse.resize(pattern_.size, pattern_.size);
    f.sparse.setFromTriplets(entries.begin(), entries.end());
    f.sparse.makeCompressed();
    f.sparse_lu.analyzePattern(f.sparse);
    f.analysed = true;
  }
  for (std::size_t e = 0; e < values.size(); ++e) f.sparse.valuePtr()[e] = values[e] * f.row_scale[pattern_.row[e]];
  f.sparse_lu.factorize(f.sparse);
  return f.sparse_lu.info() == Eigen::Success;
}

double Elimination::scaled(int row, double right) const { return right * factor_->row_scale[row]; }

void Elimination::solve(std::vector<double>& b) const {
  Eigen::Map<Eigen::VectorXd> x(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::VectorXd scaled = x.cwiseProduct(factor_->row_scale);
  if (factor_->dense) {
    x = factor_->lu.solve(scaled);
  } else {
    x = factor_->sparse_lu.solve(scaled);
  }
}

}  // namespace rheonet
