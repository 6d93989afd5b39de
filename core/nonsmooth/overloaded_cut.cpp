#include "core/nonsmooth/overloaded_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"

namespace rheonet {

// Far out, the slope of the dual along a direction d is the integral, over all levels, of (capacity - load) of the nodes
// above the level (below it for negative levels). A negative slope therefore implies an overloaded cut between two levels,
// most likely at the widest gap.
std::optional<OverloadedCut> CutSearch::along(const std::vector<double>& direction, double share) const {
  std::vector<int> order(load_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return direction[at(i)] < direction[at(j)]; });
  struct Gap { double width, level; };
  std::vector<Gap> gaps;
  double below = order.empty() ? 0 : std::min(0.0, direction[at(order.front())]);
  const auto meet = [&](double level) {
    if (level > below) gaps.push_back({level - below, level > 0 ? level : below});
    below = level;
  };
  bool passed = false;  // the level 0 of held nodes has been passed
  for (const int n : order) {
    if (direction[at(n)] > 0 && !passed) meet(0);
    passed = passed || direction[at(n)] > 0;
    meet(direction[at(n)]);
  }
  if (!passed) meet(0);
  std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.width > b.width; });
  double range = 0;
  for (const Gap& gap : gaps) range += gap.width;
  std::vector<char> inside(load_.size()), tightest;
  double most = -std::numeric_limits<double>::infinity();
  int tight_side = 1;
  for (const Gap& gap : gaps) {
    if (gap.width < share * range) return std::nullopt;
    const int side = gap.level > 0 ? 1 : -1;
    for (std::size_t n = 0; n < inside.size(); ++n) inside[n] = side * direction[n] >= side * gap.level;
    if (overloaded(inside, side)) return simple(inside, side);
    if (const double excess = balance(inside, side).excess; excess > most) {
      most = excess;
      tight_side = side;
      tightest = inside;
    }
  }
  if (share > 0 || tightest.empty()) return std::nullopt;
  return simple(tightest, tight_side);
}

CutSearch::Balance CutSearch::balance(const std::vector<char>& inside, int side) const {
  double excess = 0, magnitude = 0;
  int terms = 0;
  const auto add = [&](double f) {
    excess += f;
    magnitude += std::abs(f);
    ++terms;
  };
  for (std::size_t n = 0; n < inside.size(); ++n) {
    if (inside[n]) add(side * load_[n]);
  }
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const BoxedBranch& b = branches_[k];
    const bool from = within(inside, b.a);
    if (!open_[k] || from == within(inside, b.b)) continue;
    add(from == (side > 0) ? -b.high : b.low);
  }
  return {excess, terms * std::numeric_limits<double>::epsilon() * magnitude};
}

bool CutSearch::overloaded(const std::vector<char>& inside, int side) const {
  const auto [excess, rounding] = balance(inside, side);
  return std::isfinite(excess) && excess > rounding;
}

/// The connected parts of the nodes with this value, without the part that reaches a held node.
std::vector<std::vector<char>> CutSearch::pieces(const std::vector<char>& of, char value) const {
  const std::size_t nodes = of.size();
  DisjointSets sets(nodes + 1);  // the last member stands for held nodes
  const auto slot = [&](int node) { return node < 0 || held_[at(node)] ? static_cast<int>(nodes) : node; };
  const auto belongs = [&](int node) { return slot(node) == static_cast<int>(nodes) ? value == 0 : of[at(node)] == value; };
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    const BoxedBranch& b = branches_[k];
    if (open_[k] && belongs(b.a) && belongs(b.b)) sets.join(slot(b.a), slot(b.b));
  }
  std::vector<int> piece_of(nodes + 1, -1);
  std::vector<std::vector<char>> result;
  for (std::size_t n = 0; n < nodes; ++n) {
    const int set = sets.find(static_cast<int>(n));
    if (of[n] != value || held_[n] || set == sets.find(static_cast<int>(nodes))) continue;
    if (piece_of[at(set)] < 0) {
      piece_of[at(set)] = static_cast<int>(result.size());
      result.emplace_back(nodes, 0);
    }
    result[at(piece_of[at(set)])][n] = 1;
  }
  return result;
}

/// The connected part of an overloaded set with the largest excess, and the nodes that only this part connects to held ones. If
/// such nodes are overloaded the other way, they are the cut instead.
OverloadedCut CutSearch::simple(std::vector<char> inside, int side) const {
  double most = -std::numeric_limits<double>::infinity();
  for (std::vector<char>& piece : pieces(std::vector<char>(inside), 1)) {
    const double excess = balance(piece, side).excess;
    if (!(excess > most)) continue;
    most = excess;
    inside.swap(piece);
  }
  for (const std::vector<char>& loose : pieces(inside, 0)) {
    if (overloaded(loose, -side)) {
      inside = loose;
      side = -side;
      break;
    }
    for (std::size_t n = 0; n < loose.size(); ++n) inside[n] = inside[n] || loose[n];
  }
  OverloadedCut cut{.inside = std::move(inside), .side = side, .branches = {}};
  const auto [excess, rounding] = balance(cut.inside, side);
  cut.excess = excess;
  cut.beyond = excess > rounding;
  for (std::size_t k = 0; k < branches_.size(); ++k) {
    if (open_[k] && within(cut.inside, branches_[k].a) != within(cut.inside, branches_[k].b)) cut.branches.push_back(static_cast<int>(k));
  }
  return cut;
}

}  // namespace rheonet
