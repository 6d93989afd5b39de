#include "core/nonsmooth/conductances.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

/// The place of each unknown in an order of elimination with little fill-in.
std::vector<int> places(const std::vector<Conductance>& conductances, Eigen::Index unknowns) {
  std::vector<int> place(at(static_cast<int>(unknowns)));
  std::iota(place.begin(), place.end(), 0);
  if (unknowns <= numerics::unordered_factorisation_limit) return place;
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [a, b, value] : conductances) {
    if (a < 0 || b < 0) continue;
    entries.emplace_back(a, b, 1);
    entries.emplace_back(b, a, 1);
  }
  Eigen::SparseMatrix<double> pattern(unknowns, unknowns);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  for (int k = 0; k < static_cast<int>(unknowns); ++k) place[at(order.indices()[k])] = k;
  return place;
}

/// A network of conductances from which unknowns are eliminated in the order of their places.
class StarMesh {
 public:
  StarMesh(const std::vector<Conductance>& conductances, const std::vector<int>& place)
      : later_(place.size()), held_(place.size(), 0), sum_(place.size(), 0), next_(place.size(), 0), among_(place.size(), 0) {
    for (const auto& [a, b, value] : conductances) {
      if (a == b) continue;
      if (a < 0 || b < 0) {
        held_[at(place[at(std::max(a, b))])] += value;
      } else {
        const auto [first, second] = std::minmax(place[at(a)], place[at(b)]);
        later_[at(first)].push_back({second, value});
      }
    }
  }

  bool eliminate() {
    std::vector<std::vector<std::size_t>> reach(later_.size());  // of each unknown: earlier ones whose next neighbour it is
    std::vector<int> neighbours;
    for (std::size_t k = 0; k < later_.size(); ++k) {
      neighbours.clear();
      add(later_[k].begin(), later_[k].end(), 1, neighbours);
      for (const std::size_t j : reach[k]) {
        const auto own = later_[j].begin() + next_[j]++;
        add(own + 1, later_[j].end(), own->value / sum_[j], neighbours);
        if (own + 1 != later_[j].end()) reach[at((own + 1)->place)].push_back(j);
      }
      std::sort(neighbours.begin(), neighbours.end());
      neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
      later_[k].clear();
      sum_[k] = held_[k];
      for (const int q : neighbours) {
        later_[k].push_back({q, among_[at(q)]});
        sum_[k] += std::exchange(among_[at(q)], 0);
      }
      if (sum_[k] == 0) return false;
      for (const Neighbour& n : later_[k]) held_[at(n.place)] += n.value / sum_[k] * held_[k];
      if (!neighbours.empty()) reach[at(neighbours.front())].push_back(k);
    }
    return true;
  }

  void solve(std::vector<double>& x) const {
    for (std::size_t k = 0; k < x.size(); ++k) {
      for (const Neighbour& n : later_[k]) x[at(n.place)] += n.value / sum_[k] * x[k];
    }
    for (std::size_t k = x.size(); k-- > 0;) {
      x[k] /= sum_[k];
      for (const Neighbour& n : later_[k]) x[k] += n.value / sum_[k] * x[at(n.place)];
    }
  }

 private:
  struct Neighbour { int place; double value; };

  template <class Iterator>
  void add(Iterator begin, Iterator end, double share, std::vector<int>& neighbours) {
    for (; begin != end; ++begin) {
      double& value = among_[at(begin->place)];
      if (value == 0) neighbours.push_back(begin->place);
      value += share * begin->value;
    }
  }

  std::vector<std::vector<Neighbour>> later_;  ///< For each unknown: conductances to unknowns eliminated after it.
  std::vector<double> held_;                   ///< For each unknown: its conductance to the held node.
  std::vector<double> sum_;                    ///< For each unknown, its pivot: the sum of `held_` and `later_`.
  std::vector<std::ptrdiff_t> next_;           ///< Index into `later_`: first neighbour not yet eliminated.
  std::vector<double> among_;                  ///< Conductances of the row of the pivot, by place; 0 between pivots.
};

}  // namespace

bool solve_conductances(const std::vector<Conductance>& conductances, Eigen::VectorXd& x) {
  const std::vector<int> place = places(conductances, x.size());
  StarMesh network(conductances, place);
  if (!network.eliminate()) return false;
  std::vector<double> ordered(place.size());
  for (std::size_t k = 0; k < place.size(); ++k) ordered[at(place[k])] = x[static_cast<Eigen::Index>(k)];
  network.solve(ordered);
  for (std::size_t k = 0; k < place.size(); ++k) x[static_cast<Eigen::Index>(k)] = ordered[at(place[k])];
  return true;
}

}  // namespace rheonet
