#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/dae/block_signals.hpp"
#include "core/dae/past.hpp"
#include "core/dae/state.hpp"
#include "core/netlist/time_point.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// Everything that is a given function of time: prescribed motions and applied forces, each on the smooth stretch of its
/// signal that holds now. A force or velocity that a block gives follows from more than that: see `sense`.
class Drive {
 public:
  /// Before the run, which begins at `start` [s], nodes are at `positions` [m] (one for each node of the network).
  Drive(const Network& network, const Structure& classified, double start, const std::vector<double>& positions);

  /// Goes over to the stretches that begin at t. The positions of velocity-driven nodes go on without a jump.
  void enter(double t);
  /// The next instant at which a signal or one of its derivatives jumps, or such an instant comes through a delay; infinite
  /// if none does.
  double next_break() const { return std::min(next_break_.t, past_.next_break()); }
  /// The same without what comes through delays.
  double next_signal_break() const { return next_break_.t; }
  /// `t` to all digits that are known of it, if it is the next break.
  TimePoint exact_break(double t) const { return t == next_break_.t ? next_break_ : TimePoint(t); }
  /// From here on its double stands for this time, until there is another one. Whether that changes anything.
  bool refine(TimePoint t);
  /// What a double stands for.
  TimePoint exact(double t) const { return t == exact_.t ? exact_ : TimePoint(t); }
  /// What breaks at t = next_break(), to be asked before `enter`: whether the signal of this element itself jumps there or
  /// only a derivative, and to which side it or its slope goes (0: neither).
  struct Break { int element; bool jumps; int direction; };
  std::vector<Break> breaks(double t) const;
  /// Position steps at the last `enter` (at the start: from before the run), for each motion.
  const std::vector<double>& steps() const { return steps_; }

  /// Evaluates all at time t (remembered: a second call at the same t costs nothing).
  void evaluate(double t);

  /// How far motion number `m` of the network goes from the last `enter` or `mark` until t, without steps [m]: to the digits of
  /// that way, wherever it is by then.
  double way(int m, double t) const;

  /// Gives blocks the state of the network at t; limiters go to where that puts them. From there on `evaluate` looks ahead:
  /// what is no function of time alone goes on at its present rate (velocities stay). Without blocks just `evaluate`.
  void sense(double t, const State& state);
  BlockSignals& blocks() { return blocks_; }
  const BlockSignals& blocks() const { return blocks_; }
  /// Forces, velocities and their rates from what the blocks put out now.
  void apply_blocks();
  /// The state of blocks that do not change, for a start at t from rest or in steady motion.
  void settle_blocks(double t, State& state);
  /// What has been at t, for what comes later: after a break, and after each step, with blocks evaluated there.
  void remember(double t, const std::vector<double>& velocity, const std::vector<double>& acceleration) {
    past_.remember(t, velocity, blocks_.remembered(velocity, acceleration));
    time_ = std::numeric_limits<double>::quiet_NaN();
  }
  /// What blocks put out that follows from the past and the present: see BlockSignals::look_back.
  void look_back() { blocks_.look_back(past_); }

  /// What delayed branches feel. An event at t is a break of it too.
  Past& past() { return past_; }
  const Past& past() const { return past_; }
  void mark(double t) { mark(t, true); }

  // For each motion:
  std::vector<double> position;  ///< of one that a block gives nothing is known here
  std::vector<double> velocity, acceleration;  ///< as for forces: of what a block gives the rate may be partial
  // For each force:
  std::vector<double> force, force_rate;  ///< of one that a block gives the rate is partial, at constant unknowns
  // For each delayed branch of `past`: what it feels is `felt` and `felt_now` times the velocity that its free ends have now.
  std::vector<double> felt, felt_now;

  /// The next instant after t, but not after `limit`, at which the velocity of motion a less that of motion b changes its
  /// sign (-1: ground); infinite if there is none. No crossing is missed, however short the time to the next one.
  /// Remembered: asked again before that instant, with the same `limit`, it costs nothing.
  double next_reversal(int a, int b, double t, double limit);

  /// About the largest force [N] and velocity [m/s] that the present stretches come to.
  struct Reach { double force = 0, velocity = 0; };
  Reach reach() const;

  /// Largest angular frequency of the present stretches [rad/s]: 0 if nothing oscillates.
  double fastest() const;

 private:
  struct Motion {
    int element;
    int block;
    Signal signal;
    bool by_position;
    Piece piece;
    TimePoint anchor_time;
    double anchor = 0;  ///< position at a time, from which a velocity is integrated
  };
  struct Force { int element; Signal signal; Piece piece; };
  double position_of(const Motion& m, TimePoint t) const;
  void mark(double t, bool fresh);
  void look_ahead(double t);
  void sense_network(const State& state);
  const Network* network_;
  TimePoint sensed_at_;                  ///< s
  std::vector<Dual> base_;               ///< states and what sensors told then, with their rates
  struct Flow { double w, dw, bound; };  ///< velocity, its rate, and a bound on the magnitude of its second derivative
  Flow flow(int a, int b, double t, double limit) const;
  double search_reversal(int a, int b, double t, double limit, double grain) const;
  struct Search { double from, limit, found; };

  std::vector<Motion> motions_;
  std::vector<Force> forces_;
  std::map<std::pair<int, int>, Search> searches_;  ///< the last one for each pair of motions, on the present stretches
  std::vector<double> steps_;
  TimePoint next_break_;  ///< of the signals
  TimePoint exact_;       ///< see refine
  TimePoint since_;       ///< the last `enter` or `mark`
  double stop_;            ///< of the run [s]
  bool moves_by_blocks_;
  BlockSignals blocks_;
  Past past_;  ///< after blocks_, which says what it remembers
  double time_;
};

}  // namespace rheonet
