#pragma once

#include <algorithm>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/block_entries.hpp"
#include "core/dae/block_sensors.hpp"
#include "core/dae/driven_deflections.hpp"
#include "core/dae/inertia_matrix.hpp"
#include "core/dae/inputs.hpp"
#include "core/dae/jacobian_entries.hpp"
#include "core/dae/loop_equations.hpp"
#include "core/dae/loose_dashpots.hpp"
#include "core/dae/matrix.hpp"
#include "core/dae/node_positions.hpp"
#include "core/dae/pivot_rows.hpp"
#include "core/dae/positions.hpp"
#include "core/dae/sliding_mode.hpp"
#include "core/dae/slip_forces.hpp"
#include "core/dae/state.hpp"
#include "core/dae/stick_forces.hpp"
#include "core/dae/unknown_indices.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// The equations of a network in one set of modes, F(t, y, y') = 0, of index 1 or less for any wiring. Linear in y', with a
/// matrix that is constant except for branches held at rest in parallel (SlidingModes).
///
/// Sliders add no equations: those that stick join their ends, those that slip are given forces.
///
/// Unknowns y, in this order:
///   v  velocity of a massive or viscous node; of a floating node relative to its group's reference     [m/s]
///   p  deflection of a branch, unless it is a function of time alone                                    [m]
///   f  force of a dashpot that is solved for its force                                                  [N]
///   x  position of a node that is requested and does not follow from deflections, or that a block senses or gives [m]
///   z  state of a block                                                                                 [its output]
/// Equations, each in the row of the unknown that it stands for:
///   v  balance of forces at the node:  sum f + m v' - applied = 0;  of the pivot of a train: the equation between velocities, while the
///      other nodes of the train share the balance of its pivot (Structure::TrainEquation)
///   p  of a tree branch: balance of its group as a whole;  else the loop that the branch closes:
///      sum +-(p' + creep) + sum +-v = 0
///   f  v_a - v_b - rate(f) = 0
///   x  x' - velocity = 0
///   z  z' - rate of the block's state = 0
class Dae {
 public:
  /// `needed` marks the nodes whose positions are requested (one flag a node). Network, structure and inputs must outlive this.
  Dae(const Network& network, const Structure& structure, Inputs& inputs, const std::vector<char>& needed);

  int size() const { return std::max(index_.count, 1); }
  /// Number of actual unknowns: 0 if every motion is given (size() is then 1).
  int unknowns() const { return index_.count; }
  const Network& network() const { return *network_; }
  const Structure& structure() const { return *structure_; }
  Inputs& inputs() { return *inputs_; }
  const Inputs& inputs() const { return *inputs_; }

  /// Starts from a state at time t. Sliders slip in the directions of `modes` (the structure says which ones stick). Writes y,
  /// and prepares the laws of the network for these equations.
  void enter(double t, const State& state, const Modes& modes, std::vector<double>& y);
  /// Writes the state last viewed.
  void leave(State& state) const;

  // --- What IDA needs. No allocation.
  void residual(double t, const double* y, const double* yp, double* r);
  /// dF/dy + cj dF/dy' into `values`, in the order of `pattern()`.
  void jacobian(double t, double cj, const double* y, const double* yp, double* values);
  const Pattern& pattern() const { return jacobian_.pattern(); }

  // --- What a consistent state needs (see consistency.hpp).
  bool differential(int row) const { return differential_[static_cast<std::size_t>(row)] != 0; }
  /// Rows of dF/dy' for differential equations, of dF/dy for algebraic ones: the matrix that determines y' and jumps.
  void consistency_matrix(double t, const double* y, double* values);
  /// While set, slopes of power laws are at least their secants from rest: such an iteration never overshoots rest, whereas
  /// Newton's iteration may alternate between both sides of it.
  void use_secants(bool use) { secants_ = use; }
  /// Sums of the magnitudes of the terms of each algebraic equation at the last `residual`: of forces (or a share of slope
  /// times deflection, if larger) and of velocities. The round-off of a residual is proportional to its sum.
  void magnitudes(double* r) const;
  /// dF/dt at constant y for algebraic equations, 0 for differential ones. Call after `consistency_matrix`.
  void time_derivative(double* r) const;

  // --- All quantities that follow from a state; valid until the next call of any function above.
  struct View {
    std::vector<double> velocity;      ///< For each node [m/s].
    std::vector<double> acceleration;  ///< For known and massive nodes, and for those joined to them [m/s^2]; 0 for others.
    std::vector<double> nodal;         ///< Sum of the forces of the branches and sliders at each node [N].
    std::vector<double> applied;       ///< Sum of the applied forces at each node [N].
    std::vector<double> p, f, creep;   ///< For each deflection branch.
    std::vector<double> flow;          ///< Relative velocity of each deflection branch [m/s].
    std::vector<double> dp;            ///< p' of each deflection branch [m/s].
    std::vector<double> rate_velocity, rate_force;  ///< For each rate branch.
    std::vector<double> slider_velocity, slider_force;  ///< For each slider; one that sticks may exceed its bound by round-off.
    std::vector<double> train_force;   ///< For each train [N].
    std::vector<double> position;      ///< For each known node, and for those marked as needed [m].
  };
  const View& view(double t, const double* y, const double* yp);
  const View& viewed() const { return view_; }
  const SlipForces& slip() const { return slip_; }
  /// Makes a double stand for the exact time t (see Inputs::refine). The view is computed anew if that changes anything.
  void refine(TimePoint t) {
    if (inputs_->refine(t)) viewed_ = {};
  }
  /// The last view if its arguments are the same. The laws, y and y' must not have changed since.
  const View& view_again(double t, const double* y, const double* yp) {
    const Viewed& last = viewed_;
    return last.y == y && last.yp == yp && last.t == t ? view_ : view(t, y, yp);
  }
  const DrivenDeflections& driven() const { return driven_; }
  const NodePositions& places() const { return places_; }

  /// Some algebraic unknown may change like the square root of time (a power law at rest): no polynomial approximates it, and
  /// its error says nothing of the errors of other unknowns.
  bool rough() const { return rough_; }
  /// Some algebraic unknown depends on time explicitly: an input pulls a massless node through a dashpot, say. It needs no
  /// short steps. Between steps its error is the error of the polynomial interpolation of the input.
  bool follows_time() const { return follows_time_; }
  /// y' of this unknown occurs in some equation.
  bool differentiated(int unknown) const { return differentiated_[at(unknown)] != 0; }

  const UnknownIndices& indices() const { return index_; }
  /// The positions that views give, except for known nodes, and those that are integrated.
  const Positions& positions() const { return positions_; }
  /// Sets the unknown forces of dashpots to the values that belong to the velocities of y.
  void guess_forces(double t, double* y);
  /// Slopes df/dp of all deflection branches at the state last viewed [N/m].
  const std::vector<double>& slopes();

  /// To be called when a law has begun or ceased to hold its branch at rest (DeflectionBatch::holds).
  void update_holds();
  /// Holds these branches at rest in the state (t, y, y'): see SlidingModes::enter.
  void enter_sliding_modes(double t, const double* y, const double* yp, const std::vector<SlidingMode>& sliding_modes);
  const SlidingModes& sliding_modes() const { return sliding_modes_; }
  /// Limiters take the sides that fit this state: see BlockSignals::choose.
  void choose_limits(double t, const double* y, const double* yp);

 private:
  /// All motions are given, but IDA needs an equation: y' = 0 costs nothing.
  bool idle() const { return index_.count == 0; }
  void build_pattern();
  /// visit(entry, coefficient in dF/dy').
  template <class Visit>
  void for_each_mass(Visit visit) const;
  // residual.cpp
  void gather(double t, const double* y);
  void sum_forces();
  void balances(const double* yp, double* r) const;
  void evaluate_forces(double t, const double* y);
  void balance_loose_dashpots();
  // state_evaluation.cpp
  void share_among_joined(double t);
  void view_velocities(const double* yp);
  void stiffen_resting_laws();

  const Network* network_;
  const Structure* structure_;
  Inputs* inputs_;
  StickForces stick_forces_;
  InertiaMatrix inertia_;
  Positions positions_;
  UnknownIndices index_;
  SlidingModes sliding_modes_;
  SlipForces slip_;
  LoopEquations loops_;
  JacobianEntries jacobian_;
  PivotRows pivots_;
  BlockEntries blocks_;
  BlockSensors sensors_;
  DrivenDeflections driven_;
  NodePositions places_;
  bool rough_ = false, follows_time_ = false, secants_ = false;
  std::vector<char> differential_;         ///< For each row.
  std::vector<char> differentiated_;       ///< For each unknown.
  // Work space of the residual.
  std::vector<double> work_, v_, a_, rate_in_, rate_out_, rate_d_, df_, dc_;
  View view_;
  /// Arguments of view_; null if something else has been evaluated since.
  struct Viewed { double t = 0; const double *y = nullptr, *yp = nullptr; };
  Viewed viewed_;
  LooseDashpots loose_dashpots_;
};

template <class Visit>
void Dae::for_each_mass(Visit visit) const {
  for (const JacobianEntries::Constant& mass : jacobian_.masses()) visit(mass.entry, mass.value);
  pivots_.for_each_mass(visit);
  loops_.for_each_mass(visit);
}

}  // namespace rheonet
