#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/block_past.hpp"
#include "core/dae/block_slopes.hpp"
#include "core/dae/function_block.hpp"
#include "core/dae/signal_samplers.hpp"
#include "core/netlist/time_point.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// A value within the bounds of a limiter.
Dual limited(const BlockLaw& law, Dual value);
/// A sample as a multiple of its quantum.
double quantised(const BlockLaw& law, double sample);

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
  BlockSignals(const BlockSignals&) = delete;
  BlockSignals& operator=(const BlockSignals&) = delete;

  bool any() const { return !blocks_->blocks.empty(); }
  const Blocks& blocks() const { return *blocks_; }
  /// Functions of time, and what delays need of the past.
  BlockPast& past() { return past_; }
  const BlockPast& past() const { return past_; }
  const BlockSlopes& slopes() const { return slopes_; }
  const SignalSamplers& samplers() const { return samplers_; }

  /// Generators and samplers go over to what begins at t. Returns the end of the piece of a signal that ends first, or the time of the next
  /// sample [s].
  TimePoint enter(TimePoint t) { return std::min(past_.enter(t.t), samplers_.enter(t.t)); }
  /// Evaluates the outputs of generators and delays at t, and the sensor values of prescribed motions, with rates.
  void evaluate_time(TimePoint t, const DelayHistory& history) { past_.evaluate(t, history, out_, sensed); }
  /// See BlockPast::look_back.
  void look_back(const DelayHistory& history) { past_.look_back(history, out_); }

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

  /// See BlockSlopes::update.
  void update_slopes(const DelayHistory& history) { slopes_.update(history); }

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

  // --- Blocks that sample: see SignalSamplers.
  void take_samples() {
    samplers_.take([&](int block) { return sampled(block); });
  }
  bool hold(std::size_t round) {
    return samplers_.hold(round, past_.now(), past_.reach(), [&](int block) { return sampled(block); });
  }

  /// Sets the states to their equilibrium under the present outputs of the generators. Throws SimulationError if there is none,
  /// or if it depends on how the network moves.
  void settle();

 private:
  Dual source(const Blocks::Input& in) const { return in.from_block ? out_[at(in.index)] : sensed[at(in.index)]; }
  Dual input(const Blocks::Block& block) const;
  Dual of_function(int block, bool held);
  double sampled(int block) const { return quantised(blocks_->blocks[at(block)].law, input(blocks_->blocks[at(block)]).value); }
  bool rests(const Blocks::Block& block, std::size_t argument) const;
  bool past_switch(const Blocks::Input& in) const { return in.from_block && function_of_[at(in.index)] >= 0 && functions_[at(function_of_[at(in.index)])].past_switch(); }
  struct FiredLimit { bool upper; double guard; };
  bool fire_limiter(int index, const std::map<int, FiredLimit>& limiters, bool follows);

  const Network* network_;
  const Blocks* blocks_;
  std::vector<NodeId> moves_with_;  ///< see move_with
  std::vector<int> run_;            ///< Blocks whose outputs follow from states and inputs, in the order of evaluation.
  std::vector<int> state_of_;       ///< For each block, -1.
  std::vector<int> state_blocks_;
  std::vector<Dual> out_, before_limits_;
  std::vector<signed char> side_;
  std::vector<char> bounds_friction_;          ///< For each block: its output is a parameter of a slider.
  std::vector<double> largest_before_limits_;  ///< For each of these.
  std::vector<Limit> limits_;
  struct Fired { int block; signed char side; };
  std::vector<Fired> fired_;
  bool jumps_ = false;
  std::vector<int> function_of_;    ///< For each block: index into functions_, or -1.
  std::vector<FunctionBlock> functions_;
  int undefined_ = -1;              ///< Block without a finite value.
  double undefined_at_ = 0;         ///< When [s].
  SignalSamplers samplers_;
  BlockPast past_;
  BlockSlopes slopes_;
};

}  // namespace rheonet
