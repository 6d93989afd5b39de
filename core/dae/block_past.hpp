#pragma once

#include <deque>
#include <limits>
#include <vector>

#include "core/dae/delay_history.hpp"
#include "core/netlist/time_point.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

class BlockSignals;

/// Functions of time among the blocks of a network, and outputs of blocks at earlier times, for the delays. An earlier output follows
/// from pieces of signals, from samples, and from states and sensor values, which have channels of the delay history.
class BlockPast {
 public:
  /// Both must outlive this.
  BlockPast(const Network& network, const BlockSignals& blocks);
  /// Call once, when the blocks know their states and sensors: finds what each delay depends on.
  void find_channels(const Structure& classified);

  /// Delays of the blocks [s], and the largest sum of delays in series, which is how far back the past is needed [s].
  const std::vector<double>& delays() const { return delays_; }
  double reach() const { return reach_; }
  std::size_t channels() const { return remembered_.size(); }
  /// Present values of the channels, given the velocities [m/s] and accelerations [m/s^2] of the nodes. Only the accelerations of
  /// masses are used.
  const std::vector<DelayHistory::Known>& remembered(const std::vector<double>& velocity, const std::vector<double>& acceleration);
  /// Longest step of the integrator [s]. Delays of blocks that drive a prescribed motion by more than time limit it, as they
  /// must know the acceleration beforehand. So does a share of each delay whose input can jump for want of a mass.
  double longest_step() const { return longest_step_; }

  /// Generators switch to the pieces of their signals that begin at t. Returns the end of the piece that ends first [s].
  TimePoint enter(double t);
  /// From t on a prescribed motion follows `piece`: its position or its velocity. `position` is where it is at t [m].
  void follow(int motion, double t, const Piece& piece, bool by_position, double position);
  struct Generator { int element; const Signal* signal; const Piece* piece; };
  std::vector<Generator> generators() const;

  /// Evaluates the outputs of generators and delays at t, and the sensor values of prescribed motions, with rates.
  void evaluate(TimePoint t, const DelayHistory& history, std::vector<Dual>& out, std::vector<Dual>& sensed);
  /// Evaluates anew the delays shorter than the time since the last step, whose outputs depend on the present states and sensor
  /// values too. Call after `evaluate`, with the same history.
  void look_back(const DelayHistory& history, std::vector<Dual>& out);
  /// Time of the last `evaluate` [s].
  double now() const { return now_; }
  /// Whether the output of a delay, or its rate, is discontinuous at t. Considers delays of functions of time alone: no state
  /// smooths such a discontinuity on its way.
  bool breaks(double t, const DelayHistory& history) const;

  /// A delay, and an atom (a state or a sensor value) that it may depend on at present.
  struct Pair { std::size_t delay, atom; };
  const std::vector<Pair>& pairs() const { return pairs_; }
  /// Derivative of the output of the delay by the atom as it is now, at the time of the last `evaluate`.
  double slope(const Pair& pair, const DelayHistory& history) const;
  /// The run begins in a steady state, in which the blocks had these outputs.
  void begin_with(std::vector<double> outputs) { before_run_ = std::move(outputs); }

 private:
  struct Stretch { double t; Piece piece; bool by_position; double anchor; };
  using Stretches = std::deque<Stretch>;  ///< Pieces of a signal, as far back as reach_.
  /// Evaluation of the past as seen from `now` [s]. Derivatives are by time or, unless it is -1, by the atom as it is now.
  struct Look {
    const DelayHistory& history;
    double now, aside;
    int atom = -1;
    bool present = false;  ///< The value found depends on the present.
    Dual seen(double value, double rate) const { return atom < 0 ? Dual(value, rate) : Dual(value); }
  };
  void append(Stretches& stretches, const Stretch& next) const;
  static const Stretch& stretch_at(const Stretches& stretches, double t);
  double find_reach(int block) const;
  void take_in(const Blocks::Block& block, std::vector<char>& seen, std::vector<char>& atoms_of) const;
  bool of_time_alone(int block) const;
  bool feeds_motion(int block) const;
  void find_longest_step(const Structure& classified);
  Dual output(int block, double t, Look& look) const;
  Dual source(const Blocks::Input& in, double t, Look& look) const;
  Dual function(const Blocks::Block& block, double t, Look& look) const;
  Dual input(const Blocks::Block& block, double t, Look& look) const;
  Dual remembered_at(std::size_t atom, int channel, double t, Look& look) const;

  const Network& network_;
  const BlockSignals& blocks_;
  std::vector<double> delays_;
  double reach_ = 0, longest_step_ = std::numeric_limits<double>::infinity();
  std::vector<Stretches> generated_;  ///< For each block: of the signal of a generator.
  std::vector<Stretches> moved_;      ///< For each sensor: of a prescribed motion.
  std::vector<int> channel_;          ///< For each atom, -1.
  std::vector<DelayHistory::Known> remembered_;
  std::vector<char> heavy_;           ///< For each sensor: it measures the velocity of a mass.
  std::vector<Pair> pairs_;
  std::vector<char> present_;         ///< For each block: a delay that depends on the present too.
  double now_ = 0, aside_ = 0;        ///< Time of the last `evaluate`, and offset to the side of it that was meant [s].
  std::vector<double> before_run_;    ///< Output of each block before the run, if that began in a steady state.
};

}  // namespace rheonet
