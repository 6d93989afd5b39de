#include "core/nonsmooth/conductances.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

ConductanceNetwork::ConductanceNetwork(const std::vector<Conductance>& connected, Eigen::Index unknowns) {
  const auto size = static_cast<std::size_t>(unknowns);
  place_.resize(size);
  later_.resize(size);
  held_.resize(size);
  sum_.resize(size);
  next_.resize(size);
  reach_.resize(size);
  among_.resize(size, 0);
  ordered_.resize(size);
  std::iota(place_.begin(), place_.end(), 0);
  if (unknowns <= numerics::unordered_factorisation_limit) return;
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [a, b, value] : connected) {
    if (a < 0 || b < 0) continue;
    entries.emplace_back(a, b, 1);
    entries.emplace_back(b, a, 1);
  }
  Eigen::SparseMatrix<double> pattern(unknowns, unknowns);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  for (int k = 0; k < static_cast<int>(unknowns); ++k) place_[at(order.indices()[k])] = k;
}

bool ConductanceNetwork::solve(const std::vector<Conductance>& conductances, Eigen::VectorXd& x) {
  take(conductances);
  if (!eliminate()) return false;
  std::vector<double>& y = ordered_;
  for (std::size_t k = 0; k < y.size(); ++k) y[at(place_[k])] = x[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k < y.size(); ++k) {
    for (const Neighbour& n : later_[k]) y[at(n.place)] += n.value / sum_[k] * y[k];
  }
  for (std::size_t k = y.size(); k-- > 0;) {
    y[k] /= sum_[k];
    for (const Neighbour& n : later_[k]) y[k] += n.value / sum_[k] * y[at(n.place)];
  }
  for (std::size_t k = 0; k < y.size(); ++k) x[static_cast<Eigen::Index>(k)] = y[at(place_[k])];
  return true;
}

void ConductanceNetwork::take(const std::vector<Conductance>& conductances) {
  for (std::vector<Neighbour>& neighbours : later_) neighbours.clear();
  std::fill(held_.begin(), held_.end(), 0.0);
  for (const auto& [a, b, value] : conductances) {
    if (a == b) continue;
    if (a < 0 || b < 0) {
      held_[at(place_[at(std::max(a, b))])] += value;
    } else {
      const auto [first, second] = std::minmax(place_[at(a)], place_[at(b)]);
      later_[at(first)].push_back({second, value});
    }
  }
}

bool ConductanceNetwork::eliminate() {
  std::fill(next_.begin(), next_.end(), 0);
  for (std::vector<std::size_t>& earlier : reach_) earlier.clear();
  for (std::size_t k = 0; k < later_.size(); ++k) {
    neighbours_.clear();
    add(k, 0, 1);
    for (const std::size_t j : reach_[k]) {
      const std::size_t own = next_[j]++;
      add(j, own + 1, later_[j][own].value / sum_[j]);
      if (own + 1 < later_[j].size()) reach_[at(later_[j][own + 1].place)].push_back(j);
    }
    std::sort(neighbours_.begin(), neighbours_.end());
    neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
    later_[k].clear();
    sum_[k] = held_[k];
    for (const int q : neighbours_) {
      later_[k].push_back({q, among_[at(q)]});
      sum_[k] += std::exchange(among_[at(q)], 0);
    }
    if (sum_[k] == 0) return false;
    for (const Neighbour& n : later_[k]) held_[at(n.place)] += n.value / sum_[k] * held_[k];
    if (!neighbours_.empty()) reach_[at(neighbours_.front())].push_back(k);
  }
  return true;
}

/// Adds a share of the conductances of a place, from one of its neighbours on, to those of the pivot.
void ConductanceNetwork::add(std::size_t from, std::size_t first, double share) {
  for (std::size_t k = first; k < later_[from].size(); ++k) {
    double& value = among_[at(later_[from][k].place)];
    if (value == 0) neighbours_.push_back(later_[from][k].place);
    value += share * later_[from][k].value;
  }
}

bool solve_conductances(const std::vector<Conductance>& conductances, Eigen::VectorXd& x) {
  return ConductanceNetwork(conductances, x.size()).solve(conductances, x);
}

}  // namespace rheonet
