#include "core/dae/inertia_matrix.hpp"

#include <Eigen/SparseCholesky>

#include <array>

#include "core/base/index.hpp"

namespace rheonet {

struct InertiaMatrix::Factors {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> of;
};

InertiaMatrix::InertiaMatrix(const Network& network, const Structure& structure)
    : network_(network), structure_(structure) {
  if (network.inerters.empty()) return;
  row_.assign(structure.kind.size(), -1);
  std::vector<Eigen::Triplet<double>> entries;
  const auto row = [&](NodeId node) {
    if (structure.kind[at(node)] != Kind::massive) return -1;
    int& r = row_[at(node)];
    if (r < 0) {
      r = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
      entries.emplace_back(r, r, structure.mass[at(node)]);
    }
    return r;
  };
  for (std::size_t k = 0; k < structure.inerters.size(); ++k) {
    const Branch& b = structure.inerters[k];
    if (b.a == b.b) continue;
    const double inertance = network.inerters[k].inertance;
    const int i = row(b.a), j = row(b.b);
    if (i >= 0) entries.emplace_back(i, i, inertance);
    if (j >= 0) entries.emplace_back(j, j, inertance);
    if (i < 0 || j < 0) continue;
    entries.emplace_back(i, j, -inertance);
    entries.emplace_back(j, i, -inertance);
  }
  const auto size = static_cast<Eigen::Index>(nodes_.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_ = std::make_unique<Factors>();
  factors_->of.compute(matrix);
}

InertiaMatrix::~InertiaMatrix() = default;

void InertiaMatrix::accelerate(const std::vector<double>& force, std::vector<double>& acceleration) const {
  Eigen::VectorXd right(static_cast<Eigen::Index>(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) right[static_cast<Eigen::Index>(i)] = force[at(nodes_[i])];
  for (std::size_t k = 0; k < structure_.inerters.size(); ++k) {
    const Branch& b = structure_.inerters[k];
    for (const auto& [node, other] : std::array{std::pair{b.a, b.b}, std::pair{b.b, b.a}}) {
      if (row_[at(node)] >= 0 && structure_.kind[at(other)] == Kind::known) {
        right[row_[at(node)]] += network_.inerters[k].inertance * acceleration[at(other)];
      }
    }
  }
  const Eigen::VectorXd solved = factors_->of.solve(right);
  for (std::size_t i = 0; i < nodes_.size(); ++i) acceleration[at(nodes_[i])] = solved[static_cast<Eigen::Index>(i)];
}

}  // namespace rheonet
