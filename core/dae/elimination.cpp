#include "core/dae/elimination.hpp"

#include <klu.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/network/index.hpp"

namespace rheonet {

namespace {

constexpr int dense_limit = 40;  // above this many unknowns sparse elimination wins
// A pivot off the diagonal is taken where that is smaller than this share of the largest of its column.
constexpr double pivot_share = 0.1;

/// KLU, of T. A. Davis and E. Palamadai Natarajan, ACM Transactions on Mathematical Software 37 (2010) 36: it looks for blocks that
/// can be solved one after the other, and of what is integrated each is one.
class Sparse {
 public:
  Sparse() {
    klu_defaults(&common_);
    common_.scale = 0;  // rows are scaled already
    common_.tol = pivot_share;
  }
  ~Sparse() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }
  Sparse(const Sparse&) = delete;
  Sparse& operator=(const Sparse&) = delete;

  [[nodiscard]] bool factorise(const Pattern& pattern, std::vector<double>& values) {
    // It does not change what these point to.
    int* columns = const_cast<int*>(pattern.column_start.data());
    int* rows = const_cast<int*>(pattern.row.data());
    if (!symbolic_) symbolic_ = klu_analyze(pattern.size, columns, rows, &common_);
    klu_free_numeric(&numeric_, &common_);
    if (symbolic_) numeric_ = klu_factor(columns, rows, values.data(), symbolic_, &common_);
    return numeric_ != nullptr;
  }
  void solve(Eigen::VectorXd& b) { klu_solve(symbolic_, numeric_, static_cast<int>(b.size()), 1, b.data(), &common_); }

 private:
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
};

}  // namespace

struct Elimination::Factor {
  bool dense = true;
  Eigen::MatrixXd matrix;
  Eigen::FullPivLU<Eigen::MatrixXd> lu;
  Sparse sparse;
  std::vector<double> scaled;  ///< entries of the sparse matrix
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
  f.scaled = values;
  for (std::size_t e = 0; e < values.size(); ++e) f.scaled[e] *= f.row_scale[pattern_.row[e]];
  return f.sparse.factorise(pattern_, f.scaled);
}

double Elimination::scaled(int row, double right) const { return right * factor_->row_scale[row]; }

void Elimination::solve(std::vector<double>& b) const {
  Eigen::Map<Eigen::VectorXd> x(b.data(), static_cast<Eigen::Index>(b.size()));
  Eigen::VectorXd scaled = x.cwiseProduct(factor_->row_scale);
  if (factor_->dense) {
    x = factor_->lu.solve(scaled);
  } else {
    factor_->sparse.solve(scaled);
    x = scaled;
  }
}

}  // namespace rheonet
