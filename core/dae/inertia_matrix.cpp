#include "core/dae/inertia_matrix.hpp"

#include <Eigen/SparseLU>

#include <algorithm>
#include <array>

#include "core/base/index.hpp"

namespace rheonet {

struct InertiaMatrix::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<double>> of;
};

InertiaMatrix::InertiaMatrix(const Network& network, const Structure& structure)
    : network_(network), structure_(structure) {
  if (network.inerters.empty() && network.trains.empty()) return;
  row_.assign(structure.kind.size(), -1);
  const auto row = [&](NodeId node) {
    if (structure.kind[at(node)] != Kind::massive) return -1;
    int& r = row_[at(node)];
    if (r < 0) {
      r = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
      entries_.emplace_back(r, r, structure.mass[at(node)]);
    }
    return r;
  };
  for (std::size_t k = 0; k < structure.inerters.size(); ++k) {
    const Branch& b = structure.inerters[k];
    if (b.a == b.b) continue;
    const double inertance = network.inerters[k].inertance;
    const int i = row(b.a), j = row(b.b);
    if (i >= 0) entries_.emplace_back(i, i, inertance);
    if (j >= 0) entries_.emplace_back(j, j, inertance);
    if (i < 0 || j < 0) continue;
    entries_.emplace_back(i, j, -inertance);
    entries_.emplace_back(j, i, -inertance);
  }
  for (const Structure::TrainEquation& equation : structure.train_equations) {
    row(equation.pivot);
    for (const auto& [node, factor] : equation.terms) row(node);
  }
  for (std::size_t k = 0; k < structure.train_equations.size(); ++k) {
    const int r = static_cast<int>(nodes_.size() + k);
    const Structure::TrainEquation& equation = structure.train_equations[k];
    entries_.emplace_back(r, row_[at(equation.pivot)], 1);
    for (const auto& [node, factor] : equation.terms) {
      if (row_[at(node)] >= 0) entries_.emplace_back(r, row_[at(node)], factor);
    }
    const std::array<NodeId, 3>& nodes = network.trains[at(equation.train)].node;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const int place = row_[at(structure.rigid[at(nodes[i])])];
      if (place >= 0) train_entries_.push_back({place, r, at(equation.train), i});
    }
  }
  factors_ = std::make_unique<Factors>();
  if (!nodes_.empty()) take_train_forces(structure.train_forces);
}

void InertiaMatrix::take_train_forces(const std::vector<std::array<double, 3>>& train_forces) {
  std::vector<Eigen::Triplet<double>> entries = entries_;
  for (const TrainEntry& e : train_entries_) entries.emplace_back(e.row, e.column, train_forces[e.train][e.end]);
  const auto size = static_cast<Eigen::Index>(nodes_.size() + structure_.train_equations.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  factors_->of.compute(matrix);
}

InertiaMatrix::~InertiaMatrix() = default;

void InertiaMatrix::accelerate(const std::vector<double>& force, std::vector<double>& acceleration, std::vector<double>& train_force) const {
  const std::vector<Structure::TrainEquation>& equations = structure_.train_equations;
  Eigen::VectorXd right(static_cast<Eigen::Index>(nodes_.size() + equations.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) right[static_cast<Eigen::Index>(i)] = force[at(nodes_[i])];
  for (std::size_t k = 0; k < structure_.inerters.size(); ++k) {
    const Branch& b = structure_.inerters[k];
    for (const auto& [node, other] : std::array{std::pair{b.a, b.b}, std::pair{b.b, b.a}}) {
      if (row_[at(node)] >= 0 && structure_.kind[at(other)] == Kind::known) {
        right[row_[at(node)]] += network_.inerters[k].inertance * acceleration[at(other)];
      }
    }
  }
  for (std::size_t k = 0; k < equations.size(); ++k) {
    double& given = right[static_cast<Eigen::Index>(nodes_.size() + k)] = 0;
    for (const auto& [node, factor] : equations[k].terms) {
      if (row_[at(node)] < 0) given -= factor * acceleration[at(node)];
    }
  }
  const Eigen::VectorXd solved = factors_->of.solve(right);
  for (std::size_t i = 0; i < nodes_.size(); ++i) acceleration[at(nodes_[i])] = solved[static_cast<Eigen::Index>(i)];
  for (std::size_t k = 0; k < equations.size(); ++k) train_force[at(equations[k].train)] = solved[static_cast<Eigen::Index>(nodes_.size() + k)];
}

}  // namespace rheonet
