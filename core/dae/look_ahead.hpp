#pragma once

#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/dae/convex.hpp"
#include "core/dae/event_change.hpp"
#include "core/dae/event_network.hpp"
#include "core/dae/nodal_forces.hpp"
#include "core/dae/slider_bounds.hpp"

namespace rheonet {

/// The state, modes and forces at an event, before its modes are selected.
struct EventState {
  const EventNetwork& net;
  const SliderBounds& bounds;
  double t;
  bool stepped;                        ///< The forces of the sliders are those before a step of the inputs.
  const FiredGuards& fired;
  const State& state;
  const Modes& modes;
  const std::vector<double>& force;    ///< Forces of the sliders [N].
  const NodalForces& nodal;
  const std::vector<double>& accepted; ///< For each node: the imbalance that counts as a balance [N].
};

/// Over a short time h, with velocities v at its end, all forces counted from those at its beginning, and E, c the slope and
/// creep of a law in the direction of w, the network satisfies
///
///     (m/h) (v - v0) + sum of +-[ B (w - w0),  h E (w - c),  a slider's within its bounds ] = dF - present imbalance
///
/// Masses outweigh dashpots, and dashpots springs, each by 1/h: so one problem decides at the level (acceleration, velocity or
/// rate of force) that determines the velocity of each slider.
class LookAhead {
 public:
  /// `train_force`: forces of the trains at the end of h, on which the bounds of their losses depend; empty: gears with losses stand still.
  /// The event's state must outlive this. Throws SimulationError if nothing balances the forces.
  LookAhead(const EventState& event, double h, const std::vector<double>& train_force);

  const ConvexNetwork& problem() const { return problem_; }
  /// The branches of the problem for a deflection branch (-1: delayed, hence a load) and for a slider.
  int law(int deflection) const { return law_[at(deflection)]; }
  int slider(std::size_t k) const { return slider_[k]; }
  /// The side at which a slider is at its bound; 0 if it is within.
  int bound_side(std::size_t slider) const { return bound_side_[slider]; }
  /// Forces of the trains that follow at the end of h [N].
  const std::vector<double>& train_force() const { return train_force_; }

  /// Whether a slider joins its ends after the event.
  bool holds(std::size_t slider) const;
  /// Whether some slider begins to slip although its force was within its bounds, or one that came to rest slips back. Between prescribed
  /// motions it slips as they do.
  bool breaks_loose() const;
  /// Whether a slider between nodes with masses, whose ends move against each other at the event, stops or turns back during the time h.
  bool stops_within() const;
  /// Whether a deflection branch that cannot be held at rest has reversed.
  bool reversed(int deflection) const;
  bool same_velocity(NodeId a, NodeId b) const;
  /// Joins known nodes of equal velocity.
  void join_given(DisjointSets& sets) const;
  /// Change of a slider's force within h, less that of its bound [N].
  double beyond_bound(std::size_t slider) const;
  /// Change of the force of a deflection branch within h, less the change that it has at rest [N].
  double beyond_rest(int deflection) const { return problem_.force(law(deflection)) - at_rest_[at(deflection)]; }
  /// Whether node b drives a train with losses, when its friction slips in the direction `slide`.
  bool b_drives(std::size_t train, int slide) const { return loss_[train].b_drives(slide, train_force_[train]); }

 private:
  void add_nodes();
  void add_inputs();
  void add_deflection_laws();
  void add_rate_laws();
  void add_inerters();
  void add_sliders();
  void meet(const Branch& branch, double slope);
  bool at_loss(std::size_t slider) const;

  const EventState* event_;
  double h_;  ///< [s]
  ConvexNetwork problem_;
  std::vector<double> slope_around_;  ///< For each node that can move: largest slope there, without sliders and power laws.
  std::vector<int> law_;              ///< For each deflection branch: see law.
  std::vector<double> creep_, at_rest_;  ///< For each deflection branch.
  std::vector<int> slider_, bound_side_;
  std::vector<double> train_force_;
  std::vector<Loss> loss_;  ///< For each train, at the end of h.
};

}  // namespace rheonet
