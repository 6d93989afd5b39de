#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/dae/block_signals.hpp"
#include "core/dae/delay_history.hpp"
#include "core/dae/state.hpp"
#include "core/netlist/time_point.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Velocity with which a motion by acceleration begins [m/s].
double start_velocity(const Network& network, const Network::Motion& motion);

struct TimeFunctions;

/// All given functions of time: prescribed motions and applied forces, each on the smooth piece of its signal that holds now. A
/// force or velocity given by a block depends on more than time: see `sense`.
class Inputs {
 public:
  /// Before the run, which begins at `start` [s], nodes are at `positions` [m] (one for each node of the network).
  Inputs(const Network& network, const Structure& classified, double start, const std::vector<double>& positions);

  /// Selects the pieces of the signals that begin at t. The positions of velocity-driven nodes continue without a jump. `jumps`: the
  /// output of a function jumps at t, as an input may.
  void enter(double t, bool jumps = false);
  /// Time of the next discontinuity of a signal or of one of its derivatives, or of its arrival through a delay [s]; infinite
  /// if there is none.
  double next_break() const { return std::min(next_break_.t, history_.next_break()); }
  /// The same without arrivals through delays.
  double next_signal_break() const { return next_break_.t; }
  /// `t` to all known digits, if it is the next discontinuity.
  TimePoint exact_break(double t) const { return t == next_break_.t ? next_break_ : TimePoint(t); }
  /// From now on the double nearest to t stands for the exact time t. Returns whether that changes anything.
  bool refine(TimePoint t);
  /// The exact time that a double stands for.
  TimePoint exact(double t) const { return t == exact_.t ? exact_ : TimePoint(t); }
  /// The signals that are discontinuous at t = next_break(), and the samples that are due; call before `enter`. `what`: a "jump" of the signal itself, a
  /// "corner" of it or of a derivative, or a "sample". `direction`: sign of the jump of the signal or of its slope (0: neither jumps).
  struct Break { int element; const char* what; int direction; };
  std::vector<Break> breaks(double t) const;
  /// Steps of position at the last `enter` (at the start: from before the run), for each motion.
  const std::vector<double>& steps() const { return steps_; }

  /// Evaluates everything at time t; a second call at the same t costs nothing.
  void evaluate(double t);

  /// Displacement of motion number `m` of the network from the last `enter` or `mark` until t, without steps [m]. Its round-off
  /// is relative to this displacement, not to the position.
  double way(int m, double t) const;

  /// Gives blocks the state of the network at t; limiters take the sides that fit it. Afterwards `evaluate` extrapolates states
  /// and sensor values at their present rates (velocities stay). Without blocks just `evaluate`.
  void sense(double t, const State& state);
  /// Afterwards `evaluate` extrapolates the velocities that blocks sense too, at these accelerations of the nodes; until the next `sense`.
  void accelerate(const std::vector<double>& acceleration);
  BlockSignals& blocks() { return blocks_; }
  const BlockSignals& blocks() const { return blocks_; }
  /// Takes forces, velocities, parameters of sliders and their rates from the present outputs of the blocks.
  void apply_blocks();
  /// Sets the blocks' states to their equilibrium, for a start at t from rest or in steady motion.
  void settle_blocks(double t, State& state);
  /// Stores the present in the delay history: call after a discontinuity and after each step, with blocks evaluated at t.
  void remember(double t, const std::vector<double>& velocity, const std::vector<double>& acceleration) {
    history_.remember(t, velocity, blocks_.past().remembered(velocity, acceleration));
    time_ = std::numeric_limits<double>::quiet_NaN();
  }
  /// Outputs of delays that depend on the past and the present: see BlockSignals::look_back.
  void look_back() { blocks_.look_back(history_); }

  /// The delay history. `mark`: an event at t is a discontinuity of it too.
  DelayHistory& history() { return history_; }
  const DelayHistory& history() const { return history_; }
  void mark(double t) { mark(t, true); }

  // For each motion:
  std::vector<double> position;  ///< Undefined for a motion by a block.
  std::vector<double> velocity, acceleration;  ///< The acceleration by a block may be partial, as for forces.
  // For each force:
  std::vector<double> force, force_rate;  ///< The rate of a force by a block is partial, at constant unknowns.
  // For each delayed branch of `past`: it feels `felt` plus `felt_now` times the present velocity of its free ends [m/s].
  std::vector<double> felt, felt_now;

  /// First time after t [s], but not after `limit`, at which the velocity of motion a less that of motion b changes its sign
  /// (-1 is ground); infinite if there is none. No crossing is missed, however close the next one is. The result is cached: a
  /// call before that time, with the same `limit`, costs nothing.
  double next_reversal(int a, int b, double t, double limit);

  /// The box of a slider at the time last evaluated, in its present contact. Derivatives are rates in time, partial (at constant unknowns) where a block
  /// gives a parameter.
  const Box& box(std::size_t slider) const {
    const Network::Slider& s = network_->sliders[slider];
    const int side = s.contact ? network_->contact_of(s) : 0;
    return side == 0 ? box_[slider] : s.contact->at(side);
  }
  /// Whether the bounds of a slider depend on the velocity of this node at the same time.
  bool bounds_follow(std::size_t slider, NodeId node) const;
  /// The box of such a slider if the velocity of the node were this one, all else being as last sensed. Derivatives are by that velocity.
  Box supposed_box(std::size_t slider, NodeId node, double velocity);
  /// Bounds of the losses of trains with these forces [N].
  void transmit(const std::vector<double>& train_force) {
    if (!losses_.empty()) bound_losses(train_force);
  }
  /// A block moves a node.
  bool moves_by_blocks() const { return moves_by_blocks_; }
  /// Losses of a train at its present speed.
  const Loss& loss(std::size_t train) const { return losses_[train]; }
  /// Derivative of the sliding force of a slider to one side by its varying parameter number `which`.
  double sliding_slope(std::size_t slider, int side, std::size_t which) const;
  /// Derivative of Loss::line by this parameter of the slider that stands for the losses of a train.
  Loss::Line loss_slope(std::size_t slider, int side, bool b_drives, std::size_t which) const;

  /// Times after a and before b at which functions of time may be what they do not show at a and b. A smooth table gives the point that is
  /// farthest from the cubic through its ends; function blocks over the time give times that are `spacing` apart.
  std::vector<double> hidden_times(double a, double b, double spacing) const {
    return functions_of_time_ || smooth_tables_ ? find_hidden_times(a, b, spacing) : std::vector<double>();
  }

  /// The largest velocity of a prescribed motion, other than by a block, within a time of the present pieces [m/s].
  double largest_velocity(double begin, double end) const;

  /// Estimates of the largest force [N] and velocity [m/s] on the present pieces.
  struct Reach { double force = 0, velocity = 0; };
  Reach reach() const;

  /// The functions of time of which positions, velocities and forces are sums on the present pieces. Absent if a piece is of another kind.
  std::optional<TimeFunctions> time_functions() const;

  /// Largest angular frequency of the present pieces [rad/s]: 0 if nothing oscillates.
  double fastest() const;

 private:
  struct Motion {
    int element;
    int block;
    Signal signal;
    bool by_position, by_acceleration;
    Piece piece;             ///< Piece of the position, or of the velocity.
    TimePoint anchor_time;
    double anchor = 0;  ///< Position at a time, from which a velocity is integrated.
  };
  struct Force { int element; Signal signal; Piece piece; };
  double position_of(const Motion& m, TimePoint t) const;
  static double largest_velocity_of(const Motion& m, double begin, double end);
  const std::function<Loss(std::span<const double>)>& loss_law(const Network::Slider& slider) const;
  void bound_losses(const std::vector<double>& train_force);
  void bound_losses(std::size_t train);
  void mark(double t, bool fresh);
  std::vector<double> find_hidden_times(double a, double b, double spacing) const;
  void look_ahead(double t);
  void sense_network(const State& state);
  const Network* network_;
  TimePoint sensed_at_;                  ///< s
  std::vector<Dual> base_;               ///< States and sensor values at that time, with their rates.
  struct Flow { double w, dw, bound; };  ///< Velocity, its rate, and a bound on the magnitude of its second derivative.
  Flow flow(int a, int b, double t, double limit) const;
  double search_reversal(int a, int b, double t, double limit, double grain) const;
  struct Search { double from, limit, found; };

  std::vector<Motion> motions_;
  std::vector<Force> forces_;
  std::vector<Box> box_;                      ///< For each slider.
  std::vector<std::size_t> varying_sliders_;  ///< Sliders whose box varies.
  std::vector<Loss> losses_;                  ///< For each train.
  std::vector<double> train_force_;           ///< That the losses have their bounds for [N].
  std::map<std::pair<int, int>, Search> searches_;  ///< The last one for each pair of motions, on the present pieces.
  std::vector<double> steps_;
  TimePoint next_break_;  ///< Next one of the signals.
  TimePoint exact_;       ///< See refine.
  TimePoint since_;       ///< The last `enter` or `mark`.
  double stop_;            ///< End of the run [s].
  bool moves_by_blocks_, functions_of_time_, smooth_tables_ = false;
  BlockSignals blocks_;
  DelayHistory history_;  ///< After blocks_, which gives its channels.
  double time_;
};

}  // namespace rheonet
