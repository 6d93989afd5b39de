#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "core/network/index.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// How well forces are known that balance others [N]: as well as all the others at a node where they are the only one that is
/// not told by a law of its own.
///
/// Which balance tells which force is found once (`attach`); what it tells, as often as one likes: `begin`, `add_told` for all
/// that laws tell, `find`.
class BalancedForces {
 public:
  /// `forces`: the branches of those that have to be found. The first `otherwise` of them are known in a way of their own where
  /// no balance tells them.
  void attach(const Structure& structure, std::vector<Branch> forces, std::size_t otherwise);

  void begin();
  void add_told(const Branch& b, double noise) {
    if (b.a == b.b) return;
    at_node_[at(b.a)] += noise;
    at_node_[at(b.b)] += noise;
  }
  /// Follows every balance as far as it tells something. `other(k)`: of force k in the way of its own.
  template <class Other>
  void find(Other other) {
    for (const Found& f : order_) {
      noise_[f.force] = f.by >= 0 ? at_node_[at(f.by)] : other(f.force);
      add_told(forces_[f.force], noise_[f.force]);
    }
  }
  /// Of force k; 0 if nothing tells it.
  double noise(std::size_t k) const { return noise_[k]; }

 private:
  struct Found { std::size_t force; NodeId by; };  ///< by the balance of a node; -1: otherwise

  std::vector<Branch> forces_;
  std::vector<Found> order_;
  std::vector<double> at_node_, noise_;
};

}  // namespace rheonet
