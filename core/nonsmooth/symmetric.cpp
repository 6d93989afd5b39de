#include "core/nonsmooth/symmetric.hpp"

#include <Eigen/SparseCholesky>
#include <array>

namespace rheonet {

namespace {

constexpr Eigen::Index largest_dense = 8;  // up to so many there is nothing to gain from a sparse matrix, and it takes many times as long

bool solve_few(const std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  std::array<double, static_cast<std::size_t>(largest_dense * largest_dense)> values{};
  const auto a = [&](Eigen::Index row, Eigen::Index column) -> double& { return values[static_cast<std::size_t>(row * largest_dense + column)]; };
  for (const Eigen::Triplet<double>& entry : entries) a(entry.row(), entry.col()) += entry.value();
  // D comes on the diagonal, L below it.
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index k = 0; k < j; ++k) a(j, j) -= a(j, k) * a(j, k) * a(k, k);
    if (a(j, j) == 0) return false;
    for (Eigen::Index i = j + 1; i < n; ++i) {
      for (Eigen::Index k = 0; k < j; ++k) a(i, j) -= a(i, k) * a(j, k) * a(k, k);
      a(i, j) /= a(j, j);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < i; ++k) x[i] -= a(i, k) * x[k];
  }
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    x[i] /= a(i, i);
    for (Eigen::Index k = i + 1; k < n; ++k) x[i] -= a(k, i) * x[k];
  }
  return true;
}

}  // namespace

bool solve_symmetric(const std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& x) {
  if (x.size() <= largest_dense) return solve_few(entries, x);
  Eigen::SparseMatrix<double> matrix(x.size(), x.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return false;
  x = factor.solve(x).eval();
  return true;
}

}  // namespace rheonet
