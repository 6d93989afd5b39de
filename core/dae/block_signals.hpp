#pragma once

#include <deque>
#include <limits>
#include <map>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/delay_history.hpp"
#include "core/dae/function_block.hpp"
#include "core/netlist/time_point.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// The blocks of a network in operation: computes the output of each block from the functions of time, the states, the sensor
/// values and the past.
///
/// At an event a limiter switches between following its input and holding a bound, and a function carries a switch over to its
/// other side. Between events both keep their sides, beyond the bound too, so that their outputs stay smooth.
class BlockSignals {
 public:
  /// `classified` says which nodes have a velocity or position of their own in every mode. Throws SimulationError if a force
  /// would depend on itself at the same time (an algebraic loop).
  BlockSignals(const Network& network, const Structure& classified);

  bool any() const { return !blocks_->blocks.empty(); }
  const Blocks& blocks() const { return *blocks_; }

  // --- The past.
  /// Delays of the blocks [s], and the largest sum of delays in series, which is how far back the past is needed [s].
  const std::vector<double>& delays() const { return delays_; }
  double reach() const { return reach_; }
  std::size_t channels() const { return channel_count_; }
  /// Present values of the channels of the past, given the velocities [m/s] and accelerations [m/s^2] of the nodes. Only the
  /// accelerations of masses are used.
  const std::vector<DelayHistory::Known>& remembered(const std::vector<double>& velocity, const std::vector<double>& acceleration);
  /// Longest step of the integrator [s]. Delays of blocks that drive a prescribed motion by more than time limit it, as they
  /// must know the acceleration beforehand. So does a share of each delay whose input can jump for want of a mass.
  double longest_step() const { return longest_step_; }

  // --- Functions of time.
  /// Generators switch to the pieces of their signals that begin at t, and samples that are due at t begin. Returns the end of the piece
  /// that ends first, or the time of the next sample [s].
  TimePoint enter(TimePoint t);
  /// From t on a prescribed motion follows `piece`: its position or its velocity. `position` is where it is at t [m].
  void follow(int motion, double t, const Piece& piece, bool by_position, double position);
  struct Generator { int element; const Signal* signal; const Piece* piece; };
  std::vector<Generator> generators() const;
  /// Evaluates the outputs of generators and delays at t, and the sensor values of prescribed motions, with rates.
  void evaluate_time(TimePoint t, const DelayHistory& history);
  /// Evaluates anew the delays shorter than the time since the last step, whose outputs depend on the present states and sensor
  /// values too. Call after `evaluate_time`, with the same `past`.
  void look_back(const DelayHistory& history);

  /// Whether the output of a delay, or its rate, is discontinuous at t. Considers delays of functions of time alone: no state
  /// smooths such a discontinuity on its way.
  bool breaks(double t, const DelayHistory& history) const;

  // --- States and sensor values, with rates.
  std::vector<Dual> state;   ///< For each block with a state, in the order of the blocks.
  std::vector<Dual> sensed;  ///< For each sensor.
  int state_of(int block) const { return state_of_[at(block)]; }
  std::size_t states() const { return state_blocks_.size(); }
  int block_of_state(std::size_t state) const { return state_blocks_[state]; }
  double initial(std::size_t k) const { return blocks_->blocks[at(state_blocks_[k])].law.initial; }

  /// Evaluates all outputs. With `sides` each limiter and switch keeps its side; otherwise a limiter limits its input, and a
  /// function has its value.
  void run(bool sides);
  Dual out(int block) const { return out_[at(block)]; }
  /// The outputs of these blocks if the velocity of a node were this one, all else being equal. Derivatives are by that velocity.
  std::vector<Dual> supposed(const std::vector<int>& blocks, NodeId node, double velocity);
  /// Whether any block senses a velocity that is not given as a function of time.
  bool senses_velocities() const;
  /// Whether an output depends on the velocity of a node at the same time.
  bool follows_velocity(int block, NodeId node) const;
  /// Rate of a state [unit/s].
  double rate(std::size_t k) const;

  // --- Derivatives of outputs and of rates of states by atoms: the states first, then the sensor values.
  std::size_t atoms() const { return state.size() + sensed.size(); }
  double slope(int block, std::size_t atom) const {
    refresh_slopes();
    return slope_[at(block) * atoms() + atom];
  }
  double rate_slope(std::size_t k, std::size_t atom) const {
    refresh_slopes();
    return rate_slope_[k * atoms() + atom];
  }
  /// Recomputes them if the derivatives of delayed outputs by the present atoms have changed.
  void update_slopes(const DelayHistory& history);
  /// Whether an output can depend on an atom at the same time, if only when a sample is taken.
  bool depends(int block, std::size_t atom) const { return depends_[at(block) * atoms() + atom] != 0; }
  /// The same for an output, or for the rate of a state, through delays shorter than a step as well.
  bool couples(int block, std::size_t atom) const { return couples_[at(block) * atoms() + atom] != 0; }
  bool couples(int block) const {
    for (std::size_t atom = 0; atom < atoms(); ++atom) {
      if (couples(block, atom)) return true;
    }
    return false;
  }
  bool rate_couples(std::size_t k, std::size_t atom) const { return rate_couples_[k * atoms() + atom] != 0; }

  // --- Limiters and functions. Each finite bound and each switch has an event.
  struct Limit {
    int block;
    bool upper;              ///< For a limiter.
    std::size_t which = 0;   ///< Number of the switch of a function.
  };
  const std::vector<Limit>& limits() const { return limits_; }
  /// Positive while the limiter or switch stays on its side. Unit: that of the limiter's output, or of the values that the switch compares.
  double event_function(std::size_t limit);
  /// The guards of these limits have fired: the next `choose` switches them, whatever round-off says of their inputs. Returns whether
  /// the output of a function jumps by that.
  bool fire(const std::vector<int>& limits);
  /// Whether the output of a function jumps by the events that the last call of `fire` was given.
  bool jumps() const { return jumps_; }
  /// For the next `run(false)`: the node with which the one of each sensor of a velocity moves in the present modes; -1 for other sensors.
  void move_with(std::vector<NodeId> nodes) { moves_with_ = std::move(nodes); }
  /// After `run(false)`: each limiter and switch takes the side on which its input is now, except for those that have fired.
  void choose();
  /// Side of a limiter: -1 or 1 if its output is at the lower or upper bound.
  int side(int block) const { return side_[at(block)]; }
  /// nullptr if the block is no function.
  const FunctionBlock* function(int block) const { return function_of_[at(block)] < 0 ? nullptr : &functions_[at(function_of_[at(block)])]; }
  bool has_functions() const { return !functions_.empty(); }
  /// Throws SimulationError if a function had no finite value or slope at its last evaluation, at `since` [s] or later.
  void refuse_undefined(double since = 0) const;

  // --- Blocks that sample.
  std::vector<int> due(double t) const;  ///< Blocks with a sample at t.
  /// Samples that are due since `enter` take their input as it is now, which may jump at the same time: until `hold` they can be taken again.
  void take_samples();
  /// Ends that. Returns false, and ends nothing, if an input has jumped by more than round-off since its sample was taken. `round`: how many
  /// calls at this time came before; once there were as many as samplers, it holds in any case.
  bool hold(std::size_t round);

  /// Sets the states to their equilibrium under the present outputs of the generators. Throws SimulationError if there is none,
  /// or if it depends on how the network moves.
  void settle();

 private:
  struct Stretch { double t; Piece piece; bool by_position; double anchor; };
  static const Stretch* current(const std::deque<Stretch>& stretches, double t);
  void refuse_loops(const Network& network, const Structure& classified) const;
  void check_sensors(const Network& network, const Structure& classified) const;
  static bool loose(const Network& network, const Blocks::Sensor& sensor, const Structure& classified, const std::vector<char>& firm_node);
  void find_channels();
  double find_reach(int block) const;
  void take_in(const Blocks::Block& block, std::vector<char>& seen, std::vector<char>& atoms_of) const;
  bool of_time_alone(int block) const;
  void find_slopes(bool magnitudes, const std::vector<double>& of_delays, std::vector<double>& slope,
                   std::vector<double>& rate_slope, bool sampling = false) const;
  void refresh_slopes() const {
    if (stale_) find_slopes(false, delay_slope_, slope_, rate_slope_);
    stale_ = false;
  }
  Dual source(const Blocks::Input& in) const { return in.from_block ? out_[at(in.index)] : sensed[at(in.index)]; }
  Dual of_function(int block, bool held);
  static double quantised(const BlockLaw& law, double u);
  double sampled(const Blocks::Block& block) const { return quantised(block.law, input(block).value); }  ///< A sample of the present input.
  void find_dependence();
  bool feeds_motion(int block) const;
  void find_longest_step(const Network& network, const Structure& classified);
  Dual input(const Blocks::Block& block) const;
  Dual limited(const Blocks::Block& block, Dual v) const;
  /// Evaluation of the past as seen from `now` [s]. Derivatives are by time or, unless it is -1, by the atom as it is now.
  struct Look {
    const DelayHistory& history;
    double now, aside;
    int atom = -1;
    bool present = false;  ///< The value found depends on the present.
    Dual seen(double value, double rate) const { return atom < 0 ? Dual(value, rate) : Dual(value); }
  };
  Dual earlier(int block, double t, Look& look) const;
  Dual earlier_source(const Blocks::Input& in, double t, Look& look) const;
  Dual earlier_function(const Blocks::Block& block, double t, Look& look) const;
  Dual earlier_input(const Blocks::Block& block, double t, Look& look) const;
  Dual remembered_at(std::size_t atom, int channel, double t, Look& look) const;
  Dual motion_at(const Blocks::Sensor& sensor, const Stretch& stretch, TimePoint now) const;
  bool senses(int block, std::vector<char>& seen) const;
  double settle(int block, std::vector<char>& seen);
  [[noreturn]] void refuse_steady(int block, const char* why) const;

  const Network* network_;
  const Blocks* blocks_;
  std::vector<char> heavy_;  ///< For each sensor: it measures the velocity of a mass.
  std::vector<NodeId> moves_with_;  ///< see move_with
  bool rests(const Blocks::Block& block, std::size_t argument) const;
  bool past_switch(const Blocks::Input& in) const { return in.from_block && function_of_[at(in.index)] >= 0 && functions_[at(function_of_[at(in.index)])].past_switch(); }
  std::vector<int> run_;           ///< Blocks whose outputs follow from states and inputs, in the order of evaluation.
  std::vector<int> state_of_;      ///< For each block, -1.
  std::vector<int> state_blocks_;
  std::vector<double> delays_;
  double reach_ = 0, longest_step_ = std::numeric_limits<double>::infinity();
  std::vector<std::deque<Stretch>> generated_;  ///< For each block: pieces of a generator's signal, as far back as reach_.
  std::vector<std::deque<Stretch>> moved_;      ///< For each sensor: pieces of a prescribed motion.
  std::vector<int> state_channel_, sensor_channel_;
  std::size_t channel_count_ = 0;
  std::vector<DelayHistory::Known> remembered_;
  std::vector<Dual> out_, before_limits_;
  std::vector<signed char> side_;
  std::vector<Limit> limits_;
  struct Fired { int block; signed char side; };
  struct FiredLimit { bool upper; double guard; };
  bool fire_limiter(int index, const std::map<int, FiredLimit>& limiters, bool follows);
  std::vector<Fired> fired_;
  bool jumps_ = false;
  struct Taken { double t, value; };
  struct Sampler {
    int block;
    double number;            ///< A whole number: the last sample was at the first time not before this multiple of the period.
    TimePoint next;           ///< Time of the next sample; at first the start.
    bool taking = false;      ///< A sample is due, and still follows the input.
    double value = 0;         ///< The last sample.
    double largest = 0;       ///< Magnitude of the samples so far.
    std::deque<Taken> taken;  ///< Samples, as far back as reach_.
  };
  std::vector<int> sampler_of_;           ///< For each block: index into samplers_, or -1.
  std::vector<Sampler> samplers_;
  std::vector<int> function_of_;          ///< For each block: index into functions_, or -1.
  std::vector<FunctionBlock> functions_;
  int undefined_ = -1;                    ///< Block without a finite value.
  double undefined_at_ = 0;               ///< When [s].
  mutable std::vector<double> slope_, rate_slope_;
  mutable bool stale_ = false;            ///< Derivatives of functions have changed since they were found.
  std::vector<double> delay_slope_;
  std::vector<char> depends_, couples_, rate_couples_;
  std::vector<char> follows_;       ///< As depends_, between samples.
  std::vector<char> present_;       ///< For each block: a delay that depends on the present too.
  struct Pair { std::size_t delay, atom; };
  std::vector<Pair> pairs_;         ///< Delays, and the atoms that they may depend on at present.
  double now_ = 0, aside_ = 0;      ///< Time of the last `evaluate_time`, and offset to the side of it that was meant [s].
  std::vector<double> before_run_;  ///< Output of each block before the run, if that began in a steady state.
};

}  // namespace rheonet
