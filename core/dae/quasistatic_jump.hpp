#pragma once

#include <optional>
#include <vector>

#include "core/dae/convex.hpp"
#include "core/dae/event_network.hpp"
#include "core/dae/slider_bounds.hpp"
#include "core/dae/step_errors.hpp"

namespace rheonet {

/// Quasi-static jumps of massless nodes at an event. Forces stay finite: masses and the nodes held by dashpots keep their places. Floating
/// nodes move to where the forces balance, along the laws' own curves and against the friction of the sliders.
class QuasistaticJumps {
 public:
  /// All must outlive this.
  QuasistaticJumps(const EventNetwork& net, SliderBounds& bounds, const StepErrors& errors)
      : net_(net), network_(net.network), structure_(net.structure), inputs_(net.inputs), bounds_(bounds), errors_(errors) {}

  /// Makes the jump, up to the first contact, and lets sliders that move break away. Returns the heat [J] if anything moved. Afterwards `dx` is
  /// the rest of the steps of known and viscous nodes, still to be made. `stepped`: the inputs step. Throws SimulationError if nothing
  /// balances the forces.
  std::optional<double> jump(double t, bool stepped, std::vector<double>& dx, State& state, std::vector<double>& force);
  /// As `jump`, if the imbalance is no more than an error of the integrator's steps: friction that gives way to it does not
  /// reverse. Returns false if the forces do not balance that way.
  bool settle_errors(double t, State& state, std::vector<double>& force) const;
  /// Throws SimulationError, with names, if no displacements balance the forces under the inputs last evaluated, however large they are.
  void refuse_overload(double t, const State& state, const std::vector<double>& force) const;

 private:
  /// The displacements at the event until the forces balance under the inputs last evaluated.
  struct Jump {
    ConvexNetwork problem;
    ConvexNetwork::Outcome outcome;
    std::vector<int> slider_branch;  ///< For each slider; -1 for one that cannot move.
    double share = 1;                ///< Share of the displacements that is made: up to the first contact.
  };
  /// Empty if everything balances. With `along` each law keeps the slope of its present direction on both sides.
  std::optional<Jump> find(const std::vector<double>& dx, const State& state, const std::vector<double>& force, bool along = false) const;
  /// Displacement of a node in a jump [m].
  double moved(const Jump& jump, NodeId node) const { return jump.share * jump.problem.value(net_.slot(net_.speaker(node))); }
  double farthest(const Jump& jump) const;
  bool hardly_moves(const Jump& jump, const State& state) const;
  /// Updates the positions.
  void displace(double t, const Jump& jump, State& state) const;
  double share_to_contact(const Jump& jump, const State& state) const;

  const EventNetwork& net_;
  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  SliderBounds& bounds_;
  const StepErrors& errors_;
};

}  // namespace rheonet
