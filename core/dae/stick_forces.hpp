#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/network/structure.hpp"
#include "core/nonsmooth/boxed_forces.hpp"

namespace rheonet {

/// Forces of the sliders that stick, from the balance of forces at the nodes that they join. Where sliders form loops, or join
/// several known nodes, the balance leaves forces open: the forces are then those of least norm within the bounds. Between an
/// event and the step that finds it the load may exceed the bounds: every node still balances then, and the sliders of the
/// overloaded cut exceed their bounds. A train whose nodes they lock takes any share of the load.
class StickForces {
 public:
  StickForces(const Network& network, const Structure& structure, const Inputs& inputs);
  bool empty() const { return lone_.empty() && shared_.empty(); }

  /// `left[n]` is the sum of all other forces at node n at time t, inertia included [N]. Writes the forces of the sliders that
  /// stick, and of trains that they lock. Throws SimulationError if the forces do not meet their conditions to round-off.
  void solve(double t, const std::vector<double>& left, std::vector<double>& force, std::vector<double>& train_force);

 private:
  /// A slider that alone holds a node, or holds none: it shares no load.
  struct Lone { std::size_t slider; NodeId node; double side; };
  /// Sliders that share the loads of their nodes.
  struct Shared {
    std::vector<std::size_t> sliders;  ///< of each branch of the problem
    std::vector<NodeId> nodes;         ///< of each node of the problem
    BoxedForces problem;
    std::vector<double> load, force;
  };
  bool share_with_trains(const std::vector<double>& left, double widening, std::vector<double>& force, std::vector<double>& train_force) const;
  [[noreturn]] void report_unbalanced(double t, const Shared& shared) const;
  const Network& network_;
  const Structure& structure_;
  const Inputs& inputs_;
  std::vector<std::size_t> locked_;  ///< trains whose nodes sliders lock
  std::vector<Lone> lone_;
  std::vector<Shared> shared_;
};

}  // namespace rheonet
