#pragma once

#include <vector>

#include "core/network/network.hpp"
#include "core/network/structure.hpp"
#include "core/nonsmooth/conductances.hpp"

namespace rheonet {

/// Linear dashpots whose force is computed from the difference of two velocities, with a massless node at one end at least.
/// B (v_a - v_b) has the round-off of both velocities, unlike the other forces: a massless node does not balance. The
/// corrections of the forces that restore the balances, each as a share of its own round-off, are of least norm:
///
///     minimise sum of (df/s)^2,  s = B u (|v_a| + |v_b|),  subject to  sum of +-df = -imbalance  at each massless node
///
/// The multipliers of the balances are the potentials of a network of conductances s^2. The round-off of its balance grounds
/// each node. An imbalance that round-off does not explain stays as it is.
class LooseDashpots {
 public:
  LooseDashpots() = default;
  /// `solved`: index of the unknown force of each rate branch, -1 if it is none. The structure must outlive this.
  LooseDashpots(const Network& network, const Structure& structure, const std::vector<int>& solved);
  bool none() const { return dashpots_.empty(); }

  /// For each node: sum of the magnitudes of the forces there, the external ones, and the velocity.
  struct Nodes { const std::vector<double>&magnitude, &applied, &velocity; };
  /// Corrects the forces of the rate branches, and with them the sums of forces at the nodes, `nodal`.
  void balance(const Nodes& nodes, std::vector<double>& rate_force, std::vector<double>& nodal);

 private:
  /// `a` and `b` are the indices of its ends in `nodes_`; -1 for a mass or a prescribed motion.
  struct Dashpot { std::size_t rate; int a, b; double damping; };
  double roundoff_of(const Dashpot& dashpot, const Nodes& nodes) const;

  const Structure* structure_ = nullptr;
  std::vector<Dashpot> dashpots_;
  std::vector<NodeId> nodes_;  ///< Massless ones.
  ConductanceNetwork network_;
  std::vector<Conductance> conductances_;  ///< From each node to the held one, then of each dashpot.
  Eigen::VectorXd potential_;              ///< Of each node.
  std::vector<double> rounding_, change_;  ///< For each dashpot: round-off of its force, and the correction.
};

}  // namespace rheonet
