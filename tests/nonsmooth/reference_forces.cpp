#include "tests/nonsmooth/reference_forces.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rheonet::test {

namespace {

using Real = long double;
constexpr Real rounding = 1e-15L;

class Guess {
 public:
  Guess(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& load)
      : nodes_(static_cast<std::size_t>(nodes)), branches_(branches), load_(load), u_(branches.size()) {}

  /// `side` of each branch: -1 and 1 at a bound, 0 free. False if the balance cannot be solved.
  bool solve(const std::vector<int>& side) {
    std::vector<std::vector<Real>> a(nodes_, std::vector<Real>(nodes_ + 1, 0));
    for (std::size_t n = 0; n < nodes_; ++n) a[n][nodes_] = load_[n];
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      const BoxedBranch& b = branches_[k];
      const auto add = [&](int row, int other, int sign) {
        if (row < 0) return;
        std::vector<Real>& equation = a[static_cast<std::size_t>(row)];
        if (side[k] != 0) {
          equation[nodes_] -= sign * static_cast<Real>(side[k] > 0 ? b.high : b.low);
          return;
        }
        equation[static_cast<std::size_t>(row)] += conductance(k);
        if (other >= 0) equation[static_cast<std::size_t>(other)] -= conductance(k);
      };
      add(b.a, b.b, 1);
      add(b.b, b.a, -1);
    }
    for (std::size_t j = 0; j < nodes_; ++j) {
      std::size_t pivot = j;
      for (std::size_t i = j; i < nodes_; ++i) {
        if (std::abs(a[i][j]) > std::abs(a[pivot][j])) pivot = i;
      }
      if (std::abs(a[pivot][j]) < 1e-9L) return false;
      a[j].swap(a[pivot]);
      for (std::size_t i = 0; i < nodes_; ++i) {
        if (i == j || a[i][j] == 0) continue;
        const Real factor = a[i][j] / a[j][j];
        for (std::size_t c = j; c <= nodes_; ++c) a[i][c] -= factor * a[j][c];
      }
    }
    scale_ = 0;
    const auto phi = [&](int node) {
      const auto n = static_cast<std::size_t>(node);
      return node < 0 ? 0 : a[n][nodes_] / a[n][n];
    };
    for (std::size_t n = 0; n < nodes_; ++n) scale_ = std::max(scale_, std::abs(phi(static_cast<int>(n))));
    for (std::size_t k = 0; k < u_.size(); ++k) u_[k] = conductance(k) * (phi(branches_[k].a) - phi(branches_[k].b));
    return true;
  }

  Real conductance(std::size_t k) const { return 1 / (static_cast<Real>(branches_[k].unit) * branches_[k].unit); }
  /// Where the force of a branch without bounds lies against its box.
  int side(std::size_t k) const { return u_[k] > branches_[k].high ? 1 : u_[k] < branches_[k].low ? -1 : 0; }
  /// A force at its bound is pushed beyond it, and a free one is within.
  bool meets(const std::vector<int>& guess) const {
    for (std::size_t k = 0; k < u_.size(); ++k) {
      const Real low = branches_[k].low, high = branches_[k].high, slack = rounding * scale_ * conductance(k);
      const bool good = guess[k] == 0 ? u_[k] >= low - slack && u_[k] <= high + slack
                                      : guess[k] > 0 ? u_[k] >= high - slack : u_[k] <= low + slack;
      if (!good) return false;
    }
    return true;
  }
  ReferenceForces answer(const std::vector<int>& guess) const {
    ReferenceForces result;
    for (std::size_t k = 0; k < u_.size(); ++k) {
      result.force.push_back(guess[k] == 0 ? static_cast<double>(u_[k]) : guess[k] > 0 ? branches_[k].high : branches_[k].low);
      result.active += guess[k] != 0;
    }
    return result;
  }

 private:
  std::size_t nodes_;
  const std::vector<BoxedBranch>& branches_;
  const std::vector<double>& load_;
  std::vector<Real> u_;
  Real scale_ = 0;
};

}  // namespace

double largest_excess(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& load) {
  Real most = -INFINITY;
  for (unsigned set = 1; set < 1U << nodes; ++set) {
    const auto inside = [&](int n) { return n >= 0 && (set >> n & 1) != 0; };
    Real pushed = 0, high = 0, low = 0;
    for (int n = 0; n < nodes; ++n) pushed += inside(n) ? load[static_cast<std::size_t>(n)] : 0;
    for (const BoxedBranch& b : branches) {
      if (inside(b.a) == inside(b.b)) continue;
      high += inside(b.a) ? b.high : -b.low;
      low += inside(b.a) ? b.low : -b.high;
    }
    most = std::max({most, pushed - high, low - pushed});
  }
  return static_cast<double>(most);
}

std::optional<ReferenceForces> reference_forces(int nodes, const std::vector<BoxedBranch>& branches, const std::vector<double>& load) {
  if (largest_excess(nodes, branches, load) > 0) return std::nullopt;
  Guess guess(nodes, branches, load);
  std::vector<int> side(branches.size(), 0);
  // First guess: forces beyond their bounds without bounds. The next guesses follow from the one before.
  for (int k = 0; k < 20 && guess.solve(side); ++k) {
    if (guess.meets(side)) return guess.answer(side);
    for (std::size_t b = 0; b < side.size(); ++b) side[b] = guess.side(b);
  }
  // Then every guess.
  std::fill(side.begin(), side.end(), -1);
  for (;;) {
    if (guess.solve(side) && guess.meets(side)) return guess.answer(side);
    std::size_t k = 0;
    while (k < side.size() && side[k] == 1) side[k++] = -1;
    if (k == side.size()) throw std::runtime_error("no set of forces at their bounds is the answer");
    ++side[k];
  }
}

}  // namespace rheonet::test
