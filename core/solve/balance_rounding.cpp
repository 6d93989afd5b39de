#include "core/solve/balance_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

void BalanceRounding::attach(const Network& network, const Structure& structure) {
  network_ = &network;
  structure_ = &structure;
  place_.assign(structure.kind.size(), 0);
  for (std::size_t n = 0; n < place_.size(); ++n) place_[n] = structure.group[n] + 1;
  const std::size_t places = structure.groups.size() + 1;
  DisjointSets together(places);
  branches_.clear();
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const int a = place_[at(structure.deflections[j].a)], b = place_[at(structure.deflections[j].b)];
    if (a == b) continue;
    branches_.push_back({static_cast<int>(j), a, b});
    if (a != 0 && b != 0) together.join(a, b);
  }
  component_.resize(places);
  for (std::size_t k = 0; k < places; ++k) component_[k] = together.find(static_cast<int>(k));
  rounding_.assign(structure.deflections.size(), 0);
  force_.resize(places);
  order_.resize(branches_.size());
  up_.resize(places);
  size_.resize(places);
  by_.resize(places);
}

void BalanceRounding::find_forces(const Dae::View& view, const std::vector<double>& slope) {
  std::fill(force_.begin(), force_.end(), 0.0);
  const auto meet = [&](int place, double rounding) {
    if (place == 0) return;
    double& largest = force_[at(component_[at(place)])];
    largest = std::max(largest, rounding);
  };
  const auto meet_branch = [&](const Branch& b, double rounding) {
    meet(place_[at(b.a)], rounding);
    meet(place_[at(b.b)], rounding);
  };
  for (const Held& h : branches_) {
    const std::size_t j = at(h.branch);
    const double rounding = epsilon * std::max(numerics::sum_ulps * std::abs(view.f[j]), std::abs(slope[j] * view.p[j]));
    meet(h.a, rounding);
    meet(h.b, rounding);
  }
  const auto of_force = [](double f) { return numerics::sum_ulps * epsilon * std::abs(f); };
  for (std::size_t r = 0; r < view.rate_force.size(); ++r) meet_branch(structure_->rates[r], of_force(view.rate_force[r]));
  for (std::size_t k = 0; k < view.slider_force.size(); ++k) meet_branch(structure_->sliders[k], of_force(view.slider_force[k]));
  for (std::size_t n = 0; n < view.applied.size(); ++n) meet(place_[n], of_force(view.applied[n]));
}

void BalanceRounding::find(const Dae::View& view, const std::vector<double>& slope) {
  find_forces(view, slope);
  // Kruskal's maximum spanning tree: the softest branch on the tree's path between two places holds them together.
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int i, int j) {
    return std::abs(slope[at(branches_[at(i)].branch)]) > std::abs(slope[at(branches_[at(j)].branch)]);
  });
  std::iota(up_.begin(), up_.end(), 0);
  std::fill(size_.begin(), size_.end(), 1);
  const auto root = [&](int place) {
    while (up_[at(place)] != place) place = up_[at(place)];
    return place;
  };
  for (const int i : order_) {
    int low = root(branches_[at(i)].a), high = root(branches_[at(i)].b);
    if (low == high) continue;
    if (size_[at(low)] > size_[at(high)]) std::swap(low, high);
    up_[at(low)] = high;
    size_[at(high)] += size_[at(low)];
    by_[at(low)] = std::abs(slope[at(branches_[at(i)].branch)]);
  }
  for (const Held& h : branches_) {
    // A branch that is held at rest has a deflection of its own, whatever branches are in parallel with it.
    std::size_t i = 0;
    const bool stands = network_->batch_of(h.branch, i).holds(i);
    const double held = stands ? std::abs(slope[at(h.branch)]) : held_together(h.a, h.b);
    const double force = force_[at(component_[at(h.a != 0 ? h.a : h.b)])];
    rounding_[at(h.branch)] = held > 0 ? force / held : 0;
  }
}

/// Returns the least slope on the path from a to b [N/m]. Subtrees were joined by decreasing slope.
double BalanceRounding::held_together(int a, int b) const {
  double least = std::numeric_limits<double>::infinity();
  while (a != b) {
    // The smaller subtree is lower.
    int& lower = size_[at(a)] <= size_[at(b)] && up_[at(a)] != a ? a : b;
    least = std::min(least, by_[at(lower)]);
    lower = up_[at(lower)];
  }
  return least;
}

}  // namespace rheonet
