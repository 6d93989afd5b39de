#include "core/dae/inertia_matrix.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseLU>

#include <array>

#include "core/base/index.hpp"

namespace rheonet {

struct InertiaMatrix::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<double>> of;
  Eigen::MatrixXd train_force;  ///< the forces of the trains, from those of the equations in Structure::tied
};

InertiaMatrix::InertiaMatrix(const Network& network, const Structure& structure)
    : network_(network), structure_(structure) {
  if (network.inerters.empty() && network.trains.empty()) return;
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
  for (const Structure::Tied& tied : structure.tied) {
    row(tied.pivot);
    for (const auto& [node, factor] : tied.terms) row(node);
  }
  for (std::size_t k = 0; k < structure.tied.size(); ++k) {
    const int r = static_cast<int>(nodes_.size() + k);
    const auto put = [&](NodeId node, double factor) {
      const int i = row_[at(node)];
      if (i < 0) return;
      entries.emplace_back(r, i, factor);
      entries.emplace_back(i, r, factor);
    };
    put(structure.tied[k].pivot, 1);
    for (const auto& [node, factor] : structure.tied[k].terms) put(node, factor);
  }
  factors_ = std::make_unique<Factors>();
  find_train_forces();
  if (nodes_.empty()) return;
  const auto size = static_cast<Eigen::Index>(nodes_.size() + structure.tied.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_->of.compute(matrix);
}

InertiaMatrix::~InertiaMatrix() = default;

/// The equation of a train is the sum of those of the pivots in it, each times the factor of the pivot: so the force of each of these
/// equations is the sum of the forces of the trains times these factors. Where equations were left out, the forces have least norm.
void InertiaMatrix::find_train_forces() {
  const std::vector<Structure::Tied>& tied = structure_.tied;
  Eigen::MatrixXd factors = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(tied.size()), static_cast<Eigen::Index>(network_.trains.size()));
  for (std::size_t i = 0; i < tied.size(); ++i) {
    for (std::size_t j = 0; j < network_.trains.size(); ++j) {
      const Network::Train& train = network_.trains[j];
      for (std::size_t k = 0; k < train.node.size(); ++k) {
        if (structure_.rigid[at(train.node[k])] == tied[i].pivot) factors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += train.factor[k];
      }
    }
  }
  if (factors.size() > 0) factors_->train_force = factors.completeOrthogonalDecomposition().pseudoInverse();
}

void InertiaMatrix::accelerate(const std::vector<double>& force, std::vector<double>& acceleration, std::vector<double>& train_force) const {
  const std::vector<Structure::Tied>& tied = structure_.tied;
  Eigen::VectorXd right(static_cast<Eigen::Index>(nodes_.size() + tied.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) right[static_cast<Eigen::Index>(i)] = force[at(nodes_[i])];
  for (std::size_t k = 0; k < structure_.inerters.size(); ++k) {
    const Branch& b = structure_.inerters[k];
    for (const auto& [node, other] : std::array{std::pair{b.a, b.b}, std::pair{b.b, b.a}}) {
      if (row_[at(node)] >= 0 && structure_.kind[at(other)] == Kind::known) {
        right[row_[at(node)]] += network_.inerters[k].inertance * acceleration[at(other)];
      }
    }
  }
  for (std::size_t k = 0; k < tied.size(); ++k) {
    double& given = right[static_cast<Eigen::Index>(nodes_.size() + k)] = 0;
    for (const auto& [node, factor] : tied[k].terms) {
      if (row_[at(node)] < 0) given -= factor * acceleration[at(node)];
    }
  }
  const Eigen::VectorXd solved = factors_->of.solve(right);
  for (std::size_t i = 0; i < nodes_.size(); ++i) acceleration[at(nodes_[i])] = solved[static_cast<Eigen::Index>(i)];
  if (tied.empty()) return;
  const Eigen::VectorXd forces = factors_->train_force * solved.tail(static_cast<Eigen::Index>(tied.size()));
  for (std::size_t j = 0; j < train_force.size(); ++j) train_force[j] = forces[static_cast<Eigen::Index>(j)];
}

}  // namespace rheonet
