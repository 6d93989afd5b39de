#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/inertia_matrix.hpp"
#include "core/dae/inputs.hpp"
#include "core/dae/loose_dashpots.hpp"
#include "core/dae/matrix.hpp"
#include "core/dae/positions.hpp"
#include "core/dae/sliding_mode.hpp"
#include "core/dae/state.hpp"
#include "core/dae/stick_forces.hpp"
#include "core/dae/unknown_indices.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"
#include "core/network/train_shares.hpp"

namespace rheonet {

/// The equations of a network in one set of modes, F(t, y, y') = 0, of index 1 or less for any wiring. Linear in y', with a
/// matrix that is constant except for branches held at rest in parallel (SlidingModes).
///
/// Sliders add no equations: those that stick join their ends, those that slip are constant forces.
///
/// Unknowns y, in this order:
///   v  velocity of a massive or viscous node; of a floating node relative to its group's reference     [m/s]
///   p  deflection of a branch, unless it is a function of time alone                                    [m]
///   f  force of a dashpot that is solved for its force                                                  [N]
///   x  position of a node that is requested and does not follow from deflections, or that a block senses or gives [m]
///   z  state of a block                                                                                 [its output]
/// Equations, each in the row of the unknown that it stands for:
///   v  balance of forces at the node:  sum f + m v' - applied = 0;  of the pivot of a train: the equation between velocities, while the
///      other nodes of the train share the balance of its pivot (Structure::Tied)
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
  const Pattern& pattern() const { return pattern_; }

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
  /// For each train: factors of its force in the balances of its nodes, as in Structure, with the present losses.
  const std::vector<std::array<double, 3>>& train_forces() const { return train_forces_; }
  /// Makes a double stand for the exact time t (see Inputs::refine). The view is computed anew if that changes anything.
  void refine(TimePoint t) {
    if (inputs_->refine(t)) viewed_ = {};
  }
  /// The last view if its arguments are the same. The laws, y and y' must not have changed since.
  const View& view_again(double t, const double* y, const double* yp) {
    const Viewed& last = viewed_;
    return last.y == y && last.yp == yp && last.t == t ? view_ : view(t, y, yp);
  }
  /// Displacement of a branch that does not creep, to the last digit of its deflection. After `view`.
  double displacement(int branch) const { return view_.p[at(branch)] + offset_[at(branch)]; }
  /// Deflection at t of a branch between two prescribed nodes, which is no unknown [m].
  double driven_deflection(int branch, double t) const;

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
  /// An entry that is plus or minus the slope of a deflection or rate law.
  enum class Source : char { force, rate };
  using Sign = signed char;
  struct Scatter { int entry, index; Source source; Sign sign; };
  /// Terms [flow_begin, flow_end) of flows_ and [velocity_begin, velocity_end) of velocities_.
  struct Terms { int flow_begin, flow_end, velocity_begin, velocity_end; };
  /// Equation of a loop or position, less the velocity that a delayed branch feels (index into Inputs::felt, -1: none).
  struct Row { int row; bool position; Terms terms; int delayed; };

  /// An entry of the Jacobian due to a block: d(output, or rate of a state)/d(atom) d(atom)/dy times `factor`.
  struct Coupling {
    enum class By { itself, slope, damping };  ///< d(atom)/dy: 1, the slope of a deflection law, that of a rate law.
    int entry;
    bool of_rate;  ///< It delays the rate of state `source`, else the output of block `source`.
    std::size_t source, atom;
    double factor;
    By by;
    std::size_t branch;
  };
  /// The same through a varying parameter of a slipping slider: times the slope of its sliding force.
  struct SlidingCoupling { Coupling coupling; std::size_t slider, parameter; };
  /// The same through the share of a pivot's balance, on which the losses of a train have an influence (TrainShares).
  struct ShareCoupling { Coupling coupling; std::size_t slider, parameter; Eigen::Index share, pivot; };
  struct AtomTerm { int column; double factor; Coupling::By by; std::size_t branch; };
  std::vector<AtomTerm> terms_of_atom(std::size_t atom) const;
  std::vector<Coupling> entries_of(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor) const;
  void couple(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor,
              Coupling::By by = Coupling::By::itself, std::size_t branch = 0);
  void build_couplings(PatternBuilder& builder);
  void couple_motions(PatternBuilder& builder);
  void couple_sliders(PatternBuilder& builder);
  // varying_losses.cpp
  void couple_shares(PatternBuilder& builder);
  void follow_losses();
  void shares_jacobian(const double* yp, double* values);
  double slope(const Coupling& coupling) const;
  void move_by_blocks(const double* y);
  double acceleration_by(const Network::Motion& motion) const;
  double known_acceleration(NodeId node) const;
  void feel_blocks(const double* y);
  void block_jacobian(double* values) const;

  /// All motions are given, but IDA needs an equation: y' = 0 costs nothing.
  bool idle() const { return index_.count == 0; }
  void add_row(int row, bool position, const Structure::Loop& loop);
  Terms add_terms(const Structure::Loop& loop);
  double sum_of(const Terms& terms, const double* yp) const;
  struct Drafts;
  void build_pattern();
  void draft_balances(Drafts& drafts) const;
  void draft_rates(Drafts& drafts) const;
  void draft_rows(Drafts& drafts);
  void share_balances_of_pivots(Drafts& drafts);
  void take_entries(Drafts& drafts);
  void tie(double* values) const;
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
  std::vector<double> places(const State& state) const;
  static double sum_of(const Structure::Tied& tied, const std::vector<double>& position);
  void set_rate_forms();
  void stiffen_resting_laws();
  double held_force(const Branch& ends) const;
  double known_way(const Branch& ends, double t) const;

  const Network* network_;
  const Structure* structure_;
  Inputs* inputs_;
  StickForces stick_forces_;
  InertiaMatrix inertia_;
  Positions positions_;
  UnknownIndices index_;
  SlidingModes sliding_modes_;
  bool rough_ = false, follows_time_ = false, secants_ = false;
  std::vector<Coupling> couplings_;
  std::vector<SlidingCoupling> sliding_couplings_;
  std::vector<ShareCoupling> share_couplings_;
  std::vector<Row> rows_;
  /// For each delayed branch, the negated present velocity of its free ends. These ends are masses (otherwise no step is longer
  /// than the delay).
  std::vector<Terms> felt_terms_;
  std::vector<Structure::Term> flows_, velocities_;  ///< The terms of Terms: branches with unknown deflections, and nodes.
  std::vector<char> differential_;         ///< For each row.
  std::vector<char> differentiated_;       ///< For each unknown.
  Pattern pattern_;
  struct Constant { int entry; double value; };
  std::vector<Constant> constants_;        ///< Of dF/dy.
  /// Entries of the balances of pivots, which other rows share; then they make way for the equations of the trains.
  struct SharedEntry { int from, to; std::size_t equation, share; };
  std::vector<SharedEntry> shared_entries_;
  struct SharedMass { int entry; std::size_t equation, share; double mass; };
  std::vector<SharedMass> shared_masses_;  ///< Entries in the balances of pivots, in the rows that share them.
  std::vector<int> pivot_entries_;         ///< In the rows of pivots.
  std::vector<Constant> tied_;             ///< The coefficients of these equations.
  std::vector<Constant> masses_;           ///< Entries of dF/dy', except for flow_entries_.
  struct FlowEntry { int entry, branch; double sign; };
  /// An entry due to the present velocity that a delayed branch feels.
  struct FeltEntry { int entry, delayed; double sign; };
  // Coefficients that vanish while their branch is held at rest.
  std::vector<FlowEntry> flow_entries_;    ///< Entries of p'.
  std::vector<FlowEntry> creep_entries_;   ///< Entries of the slope of its creep.
  std::vector<FeltEntry> felt_entries_;
  std::vector<Scatter> scatter_;

  std::vector<double> offset_;  ///< Displacement less deflection of each deflection branch that does not creep.
  std::vector<double> driven_from_;    ///< For each driven branch: its deflection at the last `enter` or `mark` of the inputs [m].
  std::vector<double> slider_shift_;   ///< Displacement of each sticking slider.
  std::vector<double> tied_sum_;       ///< For each equation of a train: the sum of the positions of its nodes, times their factors [m].
  std::vector<double> slip_force_;     ///< For each slider: 0 while it sticks.
  std::vector<signed char> slip_side_; ///< For each slider: the direction in which it slips; 0 while it sticks.
  std::vector<std::size_t> varying_;   ///< Slipping sliders whose sliding force varies.
  // Losses of trains. While some depend on the speed, the last three change with it.
  std::vector<char> b_drives_;         ///< For each train.
  std::optional<TrainShares> train_shares_;  ///< If some depend on the speed.
  std::vector<Loss::Line> loss_lines_; ///< For each train whose losses slip.
  std::vector<std::array<double, 3>> train_forces_;  ///< As in Structure.
  std::vector<Structure::Tied> equations_;           ///< Equations of the trains, with the present shares.
  // Work space of the residual.
  std::vector<double> work_, v_, a_, rate_in_, rate_out_, rate_d_, df_, dc_;
  View view_;
  /// Arguments of view_; null if something else has been evaluated since.
  struct Viewed { double t = 0; const double *y = nullptr, *yp = nullptr; };
  Viewed viewed_;
  LooseDashpots loose_dashpots_;
};

/// visit(entry, coefficient in dF/dy').
template <class Visit>
void Dae::for_each_mass(Visit visit) const {
  for (const Constant& mass : masses_) visit(mass.entry, mass.value);
  for (const SharedMass& m : shared_masses_) visit(m.entry, -equations_[m.equation].shares[m.share].factor * m.mass);
  const std::vector<double>& moving = sliding_modes_.moving();
  for (const FlowEntry& f : flow_entries_) visit(f.entry, f.sign * moving[at(f.branch)]);
}

}  // namespace rheonet
