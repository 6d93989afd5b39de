#include "core/dae/bonds.hpp"

namespace rheonet {

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
}  // namespace

// Balance at each node: left + sum of +-f = 0. Of all solutions f = A phi, differences of one potential phi at the nodes, is
// the one of least norm. phi is 0 at known nodes, which take any force, and at one node of every other cluster, whose
// balance is the sum of the others'.
Bonds::Bonds(const Network& network, const Structure& structure) {
  row_.assign(structure.kind.size(), -1);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    if (structure.stuck[k]) sliders_.push_back({k, network.sliders[k].branch.a, network.sliders[k].branch.b});
  }
  for (const Bond& bond : sliders_) {
    for (NodeId node : {bond.a, bond.b}) {
      if (structure.kind[at(node)] != Kind::joined || row_[at(node)] >= 0) continue;
      row_[at(node)] = static_cast<int>(node_.size());
      node_.push_back(node);
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (const Bond& bond : sliders_) {
    const int a = row_[at(bond.a)], b = row_[at(bond.b)];
    if (a >= 0) entries.emplace_back(a, a, 1);
    if (b >= 0) entries.emplace_back(b, b, 1);
    if (a >= 0 && b >= 0) {
      entries.emplace_back(a, b, -1);
      entries.emplace_back(b, a, -1);
    }
  }
  const auto n = static_cast<Eigen::Index>(node_.size());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (n > 0) laplacian_.compute(matrix);
}

void Bonds::solve(const std::vector<double>& left, std::vector<double>& force) const {
  Eigen::VectorXd phi(static_cast<Eigen::Index>(node_.size()));
  for (std::size_t r = 0; r < node_.size(); ++r) phi[static_cast<Eigen::Index>(r)] = -left[at(node_[r])];
  if (!node_.empty()) phi = laplacian_.solve(phi);
  const auto potential = [&](NodeId node) { return row_[at(node)] < 0 ? 0 : phi[row_[at(node)]]; };
  for (const Bond& bond : sliders_) force[bond.slider] = potential(bond.a) - potential(bond.b);
}

}  // namespace rheonet
