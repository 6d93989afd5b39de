#include "core/solve/balance_followers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

namespace {

using Sort = Unknown::Sort;

}  // namespace

void BalanceFollowers::attach(const Dae& dae) {
  dae_ = &dae;
  balanced_.assign(network_.deflections.size(), -1);
  for (const Structure::Group& group : dae.structure().groups) {
    if (group.tree_branch >= 0) balanced_[at(group.tree_branch)] = group.node;
  }
}

void BalanceFollowers::restart() {
  followers_.clear();
  const Structure& structure = dae_->structure();
  std::vector<Branch> open;
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    if (dae_->indices().force[r] < 0) continue;
    followers_.push_back({Sort::force, r, false});
    open.push_back(structure.rates[r]);
  }
  const std::size_t dashpots = open.size();
  if (dashpots == 0 && std::all_of(balanced_.begin(), balanced_.end(), [](NodeId node) { return node < 0; })) return;
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    if (dae_->indices().deflection[j] < 0) continue;
    std::size_t i = 0;
    const bool held = network_.batch_of(static_cast<int>(j), i).holds(i);
    if (balanced_[j] < 0 && !held) continue;
    followers_.push_back({Sort::deflection, j, held});
    open.push_back(structure.deflections[j]);
  }
  forces_.attach(structure, std::move(open), dashpots);
}

void BalanceFollowers::tell_errors(const std::vector<double>& tolerance, const std::vector<double>& slope, const UnknownRoundoff& roundoff, const Magnitudes& seen) {
  const Structure& structure = dae_->structure();
  forces_.begin();
  for (std::size_t r = 0; r < structure.rates.size(); ++r) {
    if (dae_->indices().force[r] < 0) forces_.add_told(structure.rates[r], roundoff.dashpot(r));
  }
  longest_at_.assign(structure.kind.size(), 0);
  std::size_t next = 0;  // of the followers, which are in the order of their branches
  while (next < followers_.size() && followers_[next].sort == Sort::force) ++next;
  for (std::size_t j = 0; j < structure.deflections.size(); ++j) {
    const Branch& b = structure.deflections[j];
    for (const NodeId node : {b.a, b.b}) longest_at_[at(node)] = std::max(longest_at_[at(node)], of(seen.unknown, {Sort::deflection, static_cast<unsigned>(j)}));
    const int unknown = dae_->indices().deflection[j];
    if (next < followers_.size() && followers_[next].index == j) {
      ++next;
    } else if (unknown >= 0) {
      forces_.add_told(b, std::abs(slope[j]) * tolerance[at(unknown)]);
    }
  }
  forces_.find([&](std::size_t k) { return roundoff.dashpot(followers_[k].index); });
}

void BalanceFollowers::raise(std::vector<double>& tolerance, const std::vector<double>& slope, const UnknownRoundoff& roundoff, const Magnitudes& seen,
                             double local) {
  if (followers_.empty()) return;
  tell_errors(tolerance, slope, roundoff, seen);
  for (std::size_t k = 0; k < followers_.size(); ++k) {
    const auto [sort, index, held] = followers_[k];
    const double error = forces_.dead_band(k);
    if (sort == Sort::force) {
      double& of_force = tolerance[at(dae_->indices().force[index])];
      of_force = std::max(of_force, error);
    } else if (slope[index] != 0) {
      double& of_deflection = tolerance[at(dae_->indices().deflection[index])];
      const double all = error / std::abs(slope[index]);
      // Where friction has hardly any slope, its deflection determines the position of its end: hence the limit.
      of_deflection = std::max(of_deflection, held ? all : std::min(all, local * longest_at_[at(balanced_[index])]));
    }
  }
}

}  // namespace rheonet
