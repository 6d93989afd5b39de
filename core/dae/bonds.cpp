#include "core/dae/bonds.hpp"

#include <algorithm>
#include <cmath>

#include "core/network/index.hpp"
#include "core/network/sets.hpp"

namespace rheonet {

// Balance at each node: left + sum of +-f = 0. Of all solutions f = A phi, differences of one potential phi at the nodes, is
// the one of least norm. phi is 0 at known nodes, which take any force, and at one node of every other cluster, whose
// balance is the sum of the others'.
Bonds::Bonds(const Network& network, const Structure& structure) {
  row_.assign(structure.kind.size(), -1);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    const Network::Slider& s = network.sliders[k];
    if (structure.stuck[k]) sliders_.push_back({k, s.branch.a, s.branch.b, s.law.breakaway});
  }
  for (const Bond& bond : sliders_) {
    for (NodeId node : {bond.a, bond.b}) {
      if (structure.kind[at(node)] != Kind::joined || row_[at(node)] >= 0) continue;
      row_[at(node)] = static_cast<int>(node_.size());
      node_.push_back(node);
    }
  }
  if (!node_.empty()) laplacian_.compute(laplacian(std::vector<char>(sliders_.size(), 0)));
}

Bonds::Matrix Bonds::laplacian(const std::vector<char>& clamped) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < sliders_.size(); ++k) {
    if (clamped[k]) continue;
    const int a = row_[at(sliders_[k].a)], b = row_[at(sliders_[k].b)];
    if (a >= 0) entries.emplace_back(a, a, 1);
    if (b >= 0) entries.emplace_back(b, b, 1);
    if (a >= 0 && b >= 0) {
      entries.emplace_back(a, b, -1);
      entries.emplace_back(b, a, -1);
    }
  }
  const auto n = static_cast<Eigen::Index>(node_.size());
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Every node still has a way to one whose potential is given.
bool Bonds::still_joined(const std::vector<char>& clamped) const {
  // Number n stands for all nodes with a given potential.
  const std::size_t n = node_.size();
  Sets sets(n + 1);
  const auto number = [&](NodeId node) { return row_[at(node)] < 0 ? static_cast<int>(n) : row_[at(node)]; };
  for (std::size_t k = 0; k < sliders_.size(); ++k) {
    if (!clamped[k]) sets.join(number(sliders_[k].a), number(sliders_[k].b));
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (sets.find(static_cast<int>(k)) != sets.find(static_cast<int>(n))) return false;
  }
  return true;
}

void Bonds::solve(const std::vector<double>& left, std::vector<double>& force) const {
  if (node_.empty()) {
    for (const Bond& bond : sliders_) force[bond.slider] = 0;
    return;
  }
  if (sliders_.size() == 1 && node_.size() == 1) {  // a block that sticks by itself: there is nothing to share
    const Bond& bond = sliders_.front();
    force[bond.slider] = row_[at(bond.a)] >= 0 ? -left[at(bond.a)] : left[at(bond.b)];
    return;
  }
  std::vector<char> clamped(sliders_.size(), 0);
  const auto distribute = [&](const auto& factor) {
    Eigen::VectorXd phi(static_cast<Eigen::Index>(node_.size()));
    for (std::size_t r = 0; r < node_.size(); ++r) phi[static_cast<Eigen::Index>(r)] = -left[at(node_[r])];
    const auto add = [&](NodeId node, double f) {
      if (row_[at(node)] >= 0) phi[row_[at(node)]] -= f;
    };
    for (std::size_t k = 0; k < sliders_.size(); ++k) {
      if (!clamped[k]) continue;
      add(sliders_[k].a, force[sliders_[k].slider]);
      add(sliders_[k].b, -force[sliders_[k].slider]);
    }
    phi = factor.solve(phi);
    const auto potential = [&](NodeId node) { return row_[at(node)] < 0 ? 0 : phi[row_[at(node)]]; };
    for (std::size_t k = 0; k < sliders_.size(); ++k) {
      if (!clamped[k]) force[sliders_[k].slider] = potential(sliders_[k].a) - potential(sliders_[k].b);
    }
  };
  distribute(laplacian_);
  if (sliders_.size() == node_.size()) return;  // a tree leaves nothing open
  // What would be beyond its bound stays there, as long as the others can take the rest.
  for (bool again = true; again;) {
    again = false;
    for (std::size_t k = 0; k < sliders_.size(); ++k) {
      double& f = force[sliders_[k].slider];
      if (clamped[k] || std::abs(f) <= sliders_[k].bound) continue;
      clamped[k] = 1;
      if (!still_joined(clamped)) {
        clamped[k] = 0;
        continue;
      }
      f = std::copysign(sliders_[k].bound, f);
      again = true;
    }
    if (again) distribute(Eigen::SimplicialLDLT<Matrix>(laplacian(clamped)));
  }
}

}  // namespace rheonet
