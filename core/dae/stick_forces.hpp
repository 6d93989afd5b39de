#pragma once

#include <vector>

#include "core/dae/inputs.hpp"
#include "core/network/structure.hpp"
#include "core/nonsmooth/boxed_forces.hpp"
#include "core/nonsmooth/least_norm.hpp"

namespace rheonet {

/// Forces of the sliders that stick, from the balance of forces at the nodes that they join. Where sliders form loops, or join
/// several known nodes, the balance leaves forces open: the forces are then those of least norm within the bounds. Between an
/// event and the step that finds it the load may exceed the bounds: every node still balances then, and the sliders of the
/// overloaded cut exceed their bounds. A train whose nodes they lock takes any share of the load.
class StickForces {
 public:
  StickForces(const Network& network, const Structure& structure, const Inputs& inputs);
  bool empty() const { return lone_.empty() && shared_.empty(); }

  /// `others[n]` is the sum of all other forces at node n at time t, inertia and the forces of all trains included [N]. Writes the forces of the sliders that
  /// stick, and of trains that they lock. Throws SimulationError if the forces do not meet their conditions to round-off.
  void solve(double t, const std::vector<double>& others, std::vector<double>& force, std::vector<double>& train_force);

 private:
  /// A slider that alone holds a node, or holds none: it shares no load.
  struct Lone { std::size_t slider; NodeId node; double side; };
  /// Sliders that share the loads of their nodes, and the trains that they lock. A train has no bounds.
  struct Shared {
    std::vector<std::size_t> sliders, trains;  ///< of the branches of the problem, in this order
    std::vector<NodeId> nodes;                 ///< of each node of the problem
    BoxedForces problem{0, {}};                ///< without trains
    LeastNorm with_trains;                     ///< with them
    Eigen::MatrixXd accelerated;               ///< with trains: loads that no such force can hold, orthonormal, one a column
    std::vector<double> load, force;
    void bound(std::size_t slider, double low, double high);
    bool solve();
    void meet_bounds(double roundoff);
  };
  bool lossy(const Shared& shared) const;
  bool solve_with_losses(double t, Shared& shared, std::vector<double> found) const;
  bool share_within_losses(Shared& shared, const std::vector<double>& found) const;
  [[noreturn]] void report_unbalanced(double t, const Shared& shared) const;
  const Network& network_;
  const Structure& structure_;
  const Inputs& inputs_;
  std::vector<Lone> lone_;
  std::vector<Shared> shared_;
};

}  // namespace rheonet
