#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "core/base/index.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Round-off of forces that follow from a force balance [N]: where one force at a node has no law of its own, its error is
/// the sum of the errors of all other forces there.
///
/// `attach` finds once which balance determines which force. Then, as often as needed: `begin`, `add_told` for each force
/// that follows from a law, `find`.
class BalancedForces {
 public:
  /// `forces`: the branches of the forces to be found. Where no balance determines one of the first `otherwise` of them,
  /// `find` asks its argument for the error.
  void attach(const Structure& structure, std::vector<Branch> forces, std::size_t otherwise);

  void begin();
  void add_told(const Branch& b, double dead_band) {
    if (b.a == b.b) return;
    at_node_[at(b.a)] += dead_band;
    at_node_[at(b.b)] += dead_band;
  }
  /// Propagates the errors through all balances. `other(k)` gives the error of force k where no balance determines it.
  template <class Other>
  void find(Other other) {
    for (const Found& f : order_) {
      noise_[f.force] = f.by >= 0 ? at_node_[at(f.by)] : other(f.force);
      add_told(forces_[f.force], noise_[f.force]);
    }
  }
  /// Error of force k [N]; 0 if nothing determines it.
  double dead_band(std::size_t k) const { return noise_[k]; }

 private:
  struct Found { std::size_t force; NodeId by; };  ///< `by`: the node whose balance determines it; -1: none

  std::vector<Branch> forces_;
  std::vector<Found> order_;
  std::vector<double> at_node_, noise_;
};

}  // namespace rheonet
