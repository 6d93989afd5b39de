#pragma once

#include <string>
#include <vector>

#include "core/dae/bonds.hpp"
#include "core/dae/drive.hpp"
#include "core/dae/matrix.hpp"
#include "core/dae/positions.hpp"
#include "core/dae/state.hpp"
#include "core/network/index.hpp"
#include "core/network/network.hpp"
#include "core/network/sets.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// The equations of a network in one set of modes, F(t, y, y') = 0, of index 1 or less for any wiring. Linear in y', with a
/// matrix that is constant but for branches that are held still together (Parallel).
///
/// Sliders are no part of the equations: those that stick join their ends, those that slip are constant forces.
///
/// Unknowns y, in this order:
///   v  velocity of a massive or viscous node; of a floating node relative to its group's reference     [m/s]
///   p  deflection of a branch, unless it is a function of time alone                                    [m]
///   f  force of a dashpot that is solved for its force                                                  [N]
///   x  position of a node that is asked for and does not follow from deflections, or that a block takes in or gives [m]
///   z  state of a block                                                                                 [its output]
/// Equations, each in the row of the unknown that it stands for:
///   v  balance of forces at the node:  sum f + m v' - applied = 0
///   p  of a tree branch: balance of its group as a whole;  else the loop that the branch closes:
///      sum +-(p' + creep) + sum +-v = 0
///   f  v_a - v_b - rate(f) = 0
///   x  x' - velocity = 0
///   z  z' - rate of the block's state = 0
class Dae {
 public:
  /// `needed` marks the nodes whose positions are asked for (one flag a node). Network, structure and drive must outlive
  /// this.
  Dae(const Network& network, const Structure& structure, Drive& drive, const std::vector<char>& needed);

  int size() const { return size_; }
  /// Number of quantities that are really unknown: 0 where every motion is given (size() is then 1).
  int unknowns() const { return idle_ ? 0 : size_; }
  const Network& network() const { return *network_; }
  const Structure& structure() const { return *structure_; }
  Drive& drive() { return *drive_; }

  /// Goes on from a state at time t, with sliders that slip in the direction that `modes` says (those that stick are the
  /// structure's): gives y, and makes the laws of the network work for these equations.
  void enter(double t, const State& state, const Modes& modes, std::vector<double>& y);
  /// The state last viewed.
  void leave(State& state) const;

  // --- What IDA needs. No allocation.
  void residual(double t, const double* y, const double* yp, double* r);
  /// dF/dy + cj dF/dy' into `values`, in the order of `pattern()`.
  void jacobian(double t, double cj, const double* y, const double* yp, double* values);
  const Pattern& pattern() const { return pattern_; }

  // --- What a consistent state needs (see consistency.hpp).
  bool differential(int row) const { return differential_[static_cast<std::size_t>(row)] != 0; }
  /// Rows of dF/dy' for differential equations, of dF/dy for algebraic ones: the matrix that y' and jumps are solved with.
  void consistency_matrix(double t, const double* y, double* values);
  /// From here on slopes of power laws are no less than their secants from rest: an iteration with them never overshoots
  /// rest, where Newton's may go to and fro between both sides of it.
  void use_secants(bool use) { secants_ = use; }
  /// Sums of the magnitudes of the terms of each algebraic equation at the last `residual`, as far as they are forces (or
  /// what makes them of deflections, if that is more) and velocities: what is lost by rounding is a share of them.
  void magnitudes(double* r) const;
  /// That share.
  static constexpr double rounding_share = 1e-14;
  /// dF/dt at constant y for algebraic equations, 0 for differential ones. Call after `consistency_matrix`.
  void time_derivative(double* r) const;

  // --- Everything that follows from a state; valid until the next call of any function above.
  struct View {
    std::vector<double> velocity;      ///< of each node [m/s]
    std::vector<double> acceleration;  ///< of known and massive nodes, and of those joined to them [m/s^2]; 0 for others
    std::vector<double> nodal;         ///< sum of the forces of the branches and sliders at each node [N]
    std::vector<double> applied;       ///< sum of the applied forces at each node [N]
    std::vector<double> p, f, creep;   ///< of each deflection branch
    std::vector<double> flow;          ///< relative velocity of each deflection branch [m/s]
    std::vector<double> dp;            ///< p' of each deflection branch [m/s]
    std::vector<double> rate_velocity, rate_force;  ///< of each rate branch
    std::vector<double> slider_velocity, slider_force;  ///< of each slider; what sticks may exceed its bound by rounding
    std::vector<double> position;      ///< of each known node, and of those marked as needed [m]
  };
  const View& view(double t, const double* y, const double* yp);
  /// The same where the laws have not changed since the last view, and neither has what these pointers lead to for this time.
  /// See Drive::refine.
  void refine(TimePoint t) {
    if (drive_->refine(t)) viewed_ = {};
  }
  const View& view_again(double t, const double* y, const double* yp) {
    const Viewed& last = viewed_;
    return last.y == y && last.yp == yp && last.t == t ? view_ : view(t, y, yp);
  }
  /// Displacement of a branch that does not creep, to the last digit of its deflection. After `view`.
  double displacement(int branch) const { return view_.p[at(branch)] + offset_[at(branch)]; }
  /// Deflection at t of a branch that is no unknown [m]: both its ends are prescribed.
  double driven_deflection(int branch, double t) const;
  /// Sum of the forces at the nodes of a tie [N], and of the magnitudes of those that come from outside. After `view`.
  struct Balance { double sum, magnitude; };
  Balance balance(const Structure::Tie& tie) const;
  /// Whether a force that is applied to a tie changes with time at present.
  bool load_changes(const Structure::Tie& tie) const;

  /// Some algebraic unknown may change like the root of time (a power law at rest): no polynomial follows it, and its
  /// error says nothing of that of the others.
  bool rough() const { return rough_; }
  /// Some algebraic unknown follows from time as well as from the others: a drive pulls a massless node through a dashpot, say.
  /// No step need be short on its account, and between steps it is off by as much as the drive is from a polynomial.
  bool follows_time() const { return follows_time_; }
  /// y' of this unknown is in some equation.
  bool differentiated(int unknown) const { return differentiated_[at(unknown)] != 0; }

  /// Index of an unknown; -1 if it is none.
  int velocity_unknown(NodeId node) const { return iv_[at(node)]; }
  int deflection_unknown(int branch) const { return ip_[at(branch)]; }
  int force_unknown(int rate) const { return if_[at(rate)]; }
  /// Of a node whose distance from another one (see Positions) is integrated.
  int position_unknown(NodeId node) const { return ix_[at(node)]; }
  const std::vector<NodeId>& integrated_positions() const { return positions_.integrated; }
  /// That other one; ground if there is none.
  NodeId integrated_beside(NodeId node) const { return ix_[at(node)] < 0 ? ground : positions_.of[at(node)].parent; }
  /// Nodes whose position a view gives, but for those that are known.
  const std::vector<NodeId>& positioned() const { return positions_.order; }
  int block_unknown(std::size_t state) const { return iz_[state]; }
  /// Gives the unknown forces of dashpots the values that belong to the velocities of y.
  void guess_forces(double t, double* y);
  /// The node or element of the scene that an unknown belongs to.
  struct Subject {
    enum class Kind { node, element };
    Kind kind;
    int index;  ///< into Scene::nodes or Scene::elements
    auto operator<=>(const Subject&) const = default;
  };
  Subject subject(int unknown) const;
  /// Where the netlist names it.
  const Spot& spot_of(int unknown) const;
  /// For messages: "the velocity of node `m`", "the force of `k1`".
  std::string describe(int unknown) const;
  /// For messages: "`m`, `k1`", the elements there, which have a part in it.
  std::string around(int unknown) const;

  /// Slopes df/dp of all deflection branches at the state last viewed [N/m].
  const std::vector<double>& slopes();

  /// To be called when a law has begun or ceased to hold its branch still (DeflectionBatch::holds).
  void update_holds();
  /// Holds still, in the state (t, y, y'), the branches whose force follows from their neighbours. Where others hold the
  /// ends together already, they rest.
  void stand(double t, const double* y, const double* yp, const std::vector<Standing>& standing);
  /// All that are held still between the ends of this branch are let go as it has been: in the direction of its law.
  /// Returns them.
  std::vector<int> release_parallel(int branch, double w);

  /// Supplied and dissipated power [W] and stored energy [J] of the state last viewed. What laws turn into heat that know
  /// it in closed form is left out of the power: their sum since their memories changed last [J].
  double supplied_power() const;
  /// Whether the powers of a view hang on y': where velocities follow from rates of deflections, or laws turn these into heat.
  bool power_needs_rates() const;
  double dissipated_power() const;
  double heat_of_laws() const;
  double stored_energy() const;

  DeflectionBatch& batch_of(int branch, std::size_t& i) const { return network_->batch_of(branch, i); }
  /// What a motion applies to its node [N] in the state last viewed.
  double reaction(NodeId node) const;
  /// What a block puts out in the state last viewed.
  double output(int block) const { return drive_->blocks().out(block).value; }
  /// Limiters go to the side that this state is on: see BlockSignals::choose.
  void choose_limits(double t, const double* y, const double* yp);
  /// What force number `index` of the network applies [N] in the state last viewed.
  double applied_force(int index) const { return drive_->force[at(index)]; }

 private:
  /// An entry that is the slope of a deflection or rate law, or the negative of it.
  enum class Source : char { force, rate };
  using Sign = signed char;
  struct Scatter { int entry, index; Source source; Sign sign; };
  /// Terms [flow_begin, flow_end) of flows_ and [velocity_begin, velocity_end) of velocities_.
  struct Terms { int flow_begin, flow_end, velocity_begin, velocity_end; };
  /// A loop or a position; minus what a delayed branch feels (an index into Drive::felt, -1 for none).
  struct Row { int row; bool position; Terms terms; int delayed; };

  /// Branches between the same ends that are held still together have one velocity, 0, and so one sign of it between -1
  /// and 1 (Filippov: the same mixture of both directions for all of them). The first carries the equation w = 0, the
  /// others share its mixture: with the rates of hold_rates
  ///     (p' - backward)/(forward - backward) = (the same of the first).
  struct Parallel { std::vector<int> branches; };
  struct Follower {
    int branch, leader, row;
    bool alone;  ///< the leader has no other one
    int own_entry, leader_entry;
    std::vector<int> row_entries;
    bool active;
  };
  // standing.cpp
  void find_parallels();
  /// Holds a branch still in the state last viewed, if its law can, and with it those between the same ends. `lean` as
  /// for DeflectionBatch::hold.
  void hold_parallel(int branch, int lean);
  /// Another branch between the same ends has been held, and this one with it.
  bool beside_held(int branch, const std::vector<Standing>& standing) const;
  /// What a follower's and its leader's share in the mixture differ by [m/s], and its derivatives by p and p' of both.
  struct Shared { double difference, by_own, by_leader, by_own_rate, by_leader_rate; };
  Shared share(const Follower& follower, double own_rate, double leader_rate) const;
  void share_jacobian(double cj, const double* yp, double* values, bool consistency) const;

  /// An entry of the Jacobian that comes of a block: d(output, or rate of a state)/d(atom) d(atom)/dy times `factor`.
  struct Coupling {
    enum class By { itself, slope, damping };  ///< d(atom)/dy: 1, the slope of a deflection law, that of a rate law
    int entry;
    bool of_rate;  ///< of the state `source`, else of the output of the block `source`
    std::size_t source, atom;
    double factor;
    By by;
    std::size_t branch;
  };
  struct AtomTerm { int column; double factor; Coupling::By by; std::size_t branch; };
  std::vector<AtomTerm> terms_of_atom(std::size_t atom) const;
  void couple(PatternBuilder& builder, int row, bool of_rate, std::size_t source, double factor,
              Coupling::By by = Coupling::By::itself, std::size_t branch = 0);
  void build_couplings(PatternBuilder& builder);
  void couple_motions(PatternBuilder& builder);
  void move_by_blocks(const double* y);
  double acceleration_by(const Network::Motion& motion) const;
  void feel_blocks(const double* y);
  void block_jacobian(double* values) const;

  void number_unknowns();
  bool any_follows_time() const;
  std::vector<char> told_by_dilatant_laws(Sets told) const;
  void add_row(int row, bool position, const Structure::Loop& loop);
  Terms add_terms(const Structure::Loop& loop);
  double sum_of(const Terms& terms, const double* yp) const;
  /// The equation that balances the forces on a node's group as a whole, -1.
  int balance_of_group(NodeId node) const {
    const int group = structure_->group[at(node)];
    return group < 0 ? -1 : group_row_[at(group)];
  }
  struct Drafts;
  void build_pattern();
  void draft_balances(Drafts& drafts) const;
  void draft_rates(Drafts& drafts) const;
  void draft_rows(Drafts& drafts);
  void take_entries(Drafts& drafts);
  template <class Visit>
  void for_each_mass(Visit visit) const;
  // evaluate.cpp
  void gather(double t, const double* y);
  void sum_forces();
  void evaluate_forces(double t, const double* y);
  // loose_dashpots.cpp
  void find_loose_dashpots();
  void balance_loose_dashpots();
  // view.cpp
  void share_among_joined(double t);
  void view_velocities(const double* yp);
  std::vector<double> places(const State& state) const;
  void set_rate_forms();
  void stiffen_resting_laws();
  double known_way(const Branch& ends, double t) const;

  const Network* network_;
  const Structure* structure_;
  Drive* drive_;
  Bonds bonds_;
  Positions positions_;
  int size_ = 0;
  bool idle_ = false, rough_ = false, follows_time_ = false, secants_ = false;
  std::vector<int> iv_, ip_, if_, ix_, iz_;
  int deflections_begin_ = 0, deflections_end_ = 0;  ///< those of ip_ are one after the other
  std::vector<Coupling> couplings_;
  std::vector<Row> rows_;
  /// Of each delayed branch the negated velocity of its free ends at present, which masses have (else no step is longer than
  /// the delay).
  std::vector<Terms> felt_terms_;
  std::vector<Structure::Term> flows_, velocities_;  ///< of these: unknown deflections' branches, and nodes
  std::vector<int> group_row_;   ///< of each group
  std::vector<char> differential_;         ///< of each row
  std::vector<char> differentiated_;       ///< of each unknown
  Pattern pattern_;
  struct Constant { int entry; double value; };
  std::vector<Constant> constants_;        ///< of dF/dy
  std::vector<Constant> masses_;           ///< of dF/dy', but for flow_entries_
  struct FlowEntry { int entry, branch; double sign; };
  /// An entry of what a delayed branch feels of the present.
  struct FeltEntry { int entry, delayed; double sign; };
  std::vector<Parallel> parallels_;        ///< of two or more
  std::vector<Follower> followers_;
  // Coefficients that vanish while their branch is held still.
  std::vector<FlowEntry> flow_entries_;    ///< of p'
  std::vector<FlowEntry> creep_entries_;   ///< of the slope of its creep
  std::vector<FeltEntry> felt_entries_;
  std::vector<double> moving_;             ///< of each deflection branch: 1, or 0 while it is held still
  std::vector<Scatter> scatter_;

  std::vector<double> offset_;  ///< displacement less deflection of each deflection branch that does not creep
  std::vector<double> driven_from_;    ///< of driven ones, their deflection at the last `enter` or `mark` of the drive [m]
  std::vector<double> slider_shift_;   ///< displacement of each slider that sticks
  std::vector<double> slip_force_;     ///< of each slider: 0 while it sticks
  std::vector<char> by_force_;         ///< of each rate branch: the form in which these equations need its law
  // Work space of the residual.
  std::vector<double> work_, v_, a_, rate_in_, rate_out_, rate_d_, df_, dc_;
  View view_;
  /// Of what it is; null where something else has been evaluated since.
  struct Viewed { double t = 0; const double *y = nullptr, *yp = nullptr; };
  Viewed viewed_;
  /// A linear dashpot whose force is a difference of two velocities, with a massless node at one end at least. `a` and `b` are the
  /// indices of its ends in `loose_nodes_`; -1 for a mass or a prescribed motion.
  struct Loose { std::size_t rate; int a, b; double damping; };
  std::vector<Loose> loose_;
  std::vector<NodeId> loose_nodes_;
};

/// visit(entry, coefficient in dF/dy').
template <class Visit>
void Dae::for_each_mass(Visit visit) const {
  for (const Constant& mass : masses_) visit(mass.entry, mass.value);
  for (const FlowEntry& f : flow_entries_) visit(f.entry, f.sign * moving_[at(f.branch)]);
}

}  // namespace rheonet
