#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/disjoint_sets.hpp"
#include "core/dae/convex.hpp"
#include "core/dae/inputs.hpp"
#include "core/dae/state.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Resolves an event: steps of the inputs, jumps of massless nodes, and mode selection (which elements begin to move, in which
/// direction). Jumps and modes are convex problems over all elements at once (see convex.hpp): no mode is guessed.
class EventTransition {
 public:
  /// `classified` is the network's structure with every slider slipping. All must outlive this.
  EventTransition(const Network& network, const Structure& classified, Inputs& inputs);

  struct Change {
    double heat = 0;                 ///< Turned into heat at the event [J].
    std::vector<std::string> notes;  ///< Messages on impulses.
    std::vector<SlidingMode> sliding_modes;  ///< Deflection branches in a Filippov sliding mode at rest.
    struct Impact { int element, side; };
    std::vector<Impact> impacts;  ///< Elements whose ends are thrown back from a contact, and its side.
  };
  /// Elements whose guards have fired.
  struct Fired {
    std::vector<int> sliders;
    std::vector<int> starts;  ///< Deflection branches held at rest that begin to move in their law's direction.
    std::vector<int> turns;   ///< Deflection branches that have stopped: they rest, or go on in their law's direction.
    std::vector<int> settles; ///< Sliders that have come into contact, and whose further hops are too small to matter: they stay.
    std::vector<int> rests;   ///< Deflection branches held at rest in parallel with a slider at its bound, which sticks now.
  };
  /// Takes the state across the event at t, just after Inputs::enter if `stepped`, and selects the modes that hold afterwards.
  /// `force` holds the forces of the sliders before it, `fired` the elements whose guards fired, `horizon` the time to the next
  /// known discontinuity [s]. Throws SimulationError if nothing balances the forces.
  Change cross(double t, double horizon, bool stepped, const Fired& fired, State& state, Modes& modes,
               std::vector<double>& force);

  /// Throws SimulationError, with names and the time t, if the loads at the later time `then` exceed the forces that the laws
  /// can take, whatever moves.
  void check_load(double t, double then, const State& state, const std::vector<double>& slider_force) const;

 private:
  /// For each node: the sum of the forces, the sum of their magnitudes, and their error due to the round-off of velocities [N].
  struct Nodal { std::vector<double> sum, magnitude, rounding; };
  double time_ahead(double t, double horizon, const State& state) const;
  /// `dx`: steps of known and viscous nodes due to steps of positions. `position_steps` also finds the momentum that dashpots give to masses [N s].
  Structure take_along(double t, std::vector<double>& dx) const;
  void position_steps(double t, std::vector<double>& dx, std::vector<double>& momentum, const State& state, std::vector<std::string>& notes);
  /// The displacements at the event until the forces balance under the inputs last evaluated.
  struct Jump {
    ConvexNetwork problem;
    ConvexNetwork::Outcome outcome;
    std::vector<int> slider_branch;  ///< For each slider; -1 for one that cannot move.
    double share = 1;                ///< Share of the displacements that is made: up to the first contact.
  };
  /// Empty if everything balances. With `along` each law keeps the slope of its present direction on both sides.
  std::optional<Jump> find_jump(const std::vector<double>& dx, const State& state, const std::vector<double>& force, bool along = false) const;
  /// Applies the jump to the state, up to the first contact; true if anything moved. Afterwards `dx` is the rest of the displacements, still to be made.
  bool jump(double t, bool stepped, std::vector<double>& dx, State& state, std::vector<double>& force,
            Change& change);
  /// As `jump`, if the imbalance is no more than an error of the integrator's steps: friction that gives way to it does not
  /// reverse. Returns false if the forces do not balance that way.
  bool settle_errors(double t, State& state, std::vector<double>& force) const;
  double farthest(const Jump& jump) const;
  bool hardly_moves(const Jump& jump, const State& state) const;
  /// Displacement of a node in a jump [m].
  double moved(const Jump& jump, NodeId node) const { return jump.share * jump.problem.value(slot(speaker(node))); }
  /// Updates the positions.
  void displace(double t, const Jump& jump, State& state) const;
  /// Applies the steps that arrive through delays; returns whether there are any.
  bool take_delayed_steps(double t, State& state, Change& change);
  [[noreturn]] void report_unbalanced(double t) const;
  [[noreturn]] void report_hidden_shares(double t) const;
  // impacts.cpp
  double halt(double t, const std::vector<int>& events, const Modes& modes, State& state, std::vector<std::string>& notes) const;
  double go_on_together(const std::vector<int>& joining, const Modes& held, State& state, std::vector<std::string>& notes) const;
  double kinetic_energy(const State& state) const;
  /// Returns the impulse of each slider [N s].
  std::vector<double> share_impulses(double t, const std::vector<double>& jump, const std::vector<double>& momentum, State& state,
                                     const Modes* held = nullptr) const;
  double collide(double t, const std::vector<double>& momentum, const std::vector<int>& settles, State& state, Change& change);
  std::vector<int> moving_backwards(const State& state) const;
  std::vector<std::string> names_of(const std::vector<int>& sliders) const;
  // contacts.cpp
  bool apart(std::size_t slider) const { return network_.sliders[slider].contact && network_.contact_of(network_.sliders[slider]) == 0; }
  int contacts() const;
  double way_to_contact(std::size_t slider, double step, const State& state) const;
  double share_to_contact(const Jump& jump, const State& state) const;
  void refuse_steps_through_contacts(double t, const std::vector<double>& dx, const State& state) const;
  double rebound(double t, const std::vector<int>& hit, const std::vector<int>& settles, State& state) const;
  std::vector<double> slider_velocities(const State& state) const;
  void open_contacts(const Modes& modes, State& state, Change& change) const;
  double given_velocity(NodeId node) const;
  /// Throws SimulationError if rigid links join nodes that move at different velocities.
  void refuse_torn_links(double t) const;
  /// Throws SimulationError if prescribed motions demand a relative velocity that a law forbids.
  void refuse_blocked_motions(double t, const ConvexNetwork& problem) const;
  struct Parting { double t, of_a, of_b; };  ///< s, and velocities [m/s].
  std::optional<Parting> parting(double t, NodeId a, NodeId b) const;
  std::string moved_node(NodeId node, const std::string& how) const;
  [[noreturn]] void refuse_tearing_step(double t, NodeId first, NodeId node, double by) const;
  /// Selects the modes; returns the sliders that break away under a force above their sliding force.
  std::vector<int> select_modes(double t, double ahead, const Fired& fired, State& state, Modes& modes,
                         std::vector<double>& force, Change& change);
  /// The convex problem of mode selection, and its data.
  struct ModeSelection;
  ModeSelection look_ahead(double t, double h, const Fired& fired, const State& state, const Modes& modes, const std::vector<double>& force,
                   const Nodal& now);
  ModeSelection look_ahead(double t, double h, const Fired& fired, const State& state, const Modes& modes, const std::vector<double>& force,
                   const Nodal& now, const std::vector<double>& train_force);
  bool breaks_loose(const ModeSelection& selection) const;
  bool at_loss(const ModeSelection& selection, std::size_t slider) const;
  bool stops_within(const ModeSelection& selection, const State& state) const;
  bool holds(const ModeSelection& selection, std::size_t slider) const;
  void count_from_turns(State& state) const;
  void stop_at_turns(const Fired& fired, const Modes& modes, State& state);
  void add_nodes(ModeSelection& selection, const State& state) const;
  void add_inputs(ModeSelection& selection);
  void add_deflection_laws(ModeSelection& selection, const State& state) const;
  void add_rate_laws(ModeSelection& selection, const State& state) const;
  void add_inerters(ModeSelection& selection) const;
  /// `given`: what the changes of velocities at each train, times their factors, sum to [m/s].
  void add_trains(ConvexNetwork& problem, const std::vector<double>& given) const;
  /// The residual of the equation of each train [m/s]: the sum of its velocities times their factors.
  std::vector<double> slips_of_trains(const std::vector<double>& velocity) const;
  double turn_trains(double t, State& state, std::vector<std::string>& notes);
  void add_sliders(ModeSelection& selection) const;
  static ConvexNetwork::Law released(ConvexNetwork::Law law, double slope, double creep);
  static ConvexNetwork::Law law_of(const RateBatch& batch, std::size_t i, double w0, double scale, double steepest);
  /// Sets sliders at their bound to slip at velocity 0 where friction in parallel takes the rest of the load. Returns them.
  /// `h`: time over which the problem looks ahead [s].
  std::vector<int> let_slip(const ConvexNetwork& problem, double h, const std::vector<int>& branch_of, const std::vector<int>& slider_of,
                            const std::vector<int>& side, const std::vector<double>& at_rest, const Fired& fired,
                            Modes& modes, Change& change) const;
  /// The nodes of a group move as one at an event, as dashpots take no impulse: the first node represents them.
  NodeId speaker(NodeId node) const {
    const int g = structure_.group[static_cast<std::size_t>(node)];
    return g < 0 ? node : structure_.groups[static_cast<std::size_t>(g)].nodes.front();
  }
  /// At an event nothing moves these nodes against each other.
  bool carried(NodeId a, NodeId b) const {
    return a == b || (structure_.group[static_cast<std::size_t>(a)] < 0 && structure_.group[static_cast<std::size_t>(b)] < 0);
  }
  bool may_stand(int branch) const;
  void join_given(const ConvexNetwork& problem, DisjointSets& sets) const;
  void rest_beside_sliders(const Fired& fired, const State& state, const Modes& modes) const;
  static bool relaxes_from_bound(const ConvexNetwork& problem, int branch, const DeflectionBatch& batch, std::size_t i,
                                 double p);
  double delayed_slope(int branch, const State& state) const;
  /// A branch that cannot be held at rest has reversed.
  bool reversed(const Fired& fired, int branch) const;
  void take_directions(const ModeSelection& selection, const State& state, Change& change);
  bool same_velocity(const ConvexNetwork& problem, NodeId a, NodeId b) const;
  std::vector<NodeId> given_in(DisjointSets& sets) const;
  void keep_slipping(std::vector<double>& force);
  void take_back_excess(const Modes& modes, std::vector<double>& force);
  /// Slope of a law times its deflection [N]: the force of the law has the round-off of this product.
  static double force_of_deflection(const DeflectionBatch& batch, std::size_t i, double p);
  Nodal together(const Nodal& single) const;
  Nodal nodal(const State& state, const std::vector<double>& slider_force, bool rates) const;
  double bound(std::size_t slider, int side) const;
  /// Its rate of change [N/s].
  double bound_rate(std::size_t slider, int side) const;
  /// The node has no mass and no prescribed motion, and rigid links join it to no node that has.
  bool massless(NodeId node) const { return !firm_[static_cast<std::size_t>(node)]; }
  /// Nodes are numbered as in the equations, so that two ways to write a network give the same numbers.
  int slot(NodeId node) const { return structure_.rank[static_cast<std::size_t>(node)]; }
  struct Bounded { Branch branch; double bound; };
  std::vector<Bounded> bounded() const;
  std::vector<double> pushes(const State& state) const;
  std::vector<char> pushed_away(const std::vector<double>& push, int side, double share) const;
  std::vector<char> carried(const std::vector<int>& runaways) const;
  /// `runaways`: slots of nodes that a convex problem leaves without a bound; named only if the loads do not show the overload.
  [[noreturn]] void report_runaway(double t, const std::vector<int>& runaways, const State& state) const;

  const Network& network_;
  const Structure& structure_;
  Inputs& inputs_;
  bool started_ = false;      ///< The start has been resolved.
  bool stepped_ = false;      ///< The forces of the sliders are those before a step of the inputs.
  std::vector<char> broken_;           ///< For each slider: its bounds are its sliding force.
  std::vector<char> impulse_told_;     ///< For each element: a message has reported its impulse at a step of position.
  std::vector<signed char> slipping_;  ///< For each slider: the direction in which it slips already.
  std::vector<signed char> came_to_rest_;  ///< For each slider: the direction in which it slipped up to this event.
  std::vector<int> hit_;               ///< Sliders in contact whose ends moved towards each other at this event.
  double largest_kinetic_ = 0;         ///< At events so far [J].
  std::vector<double> slack_;          ///< For each node: imbalance that is accepted [N].
  /// True if both ends move as prescribed, through rigid links too.
  bool prescribed(const Branch& b) const { return led_by_[at(b.a)] >= 0 && led_by_[at(b.b)] >= 0; }

  std::vector<NodeId> led_by_;         ///< For each node: itself if its motion is known, a known node to which rigid links join it, or -1.
  std::vector<char> firm_;             ///< For each node: it, or a node to which rigid links join it, is known or has a mass.
};

}  // namespace rheonet
