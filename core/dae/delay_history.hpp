#pragma once

#include <array>
#include <deque>
#include <limits>
#include <vector>

#include "core/base/numerics.hpp"
#include "core/dae/polynomial.hpp"
#include "core/network/dual.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// Delay history: velocities of the ends of delayed branches, and other delayed values, as far back as the longest delay. In a
/// step longer than a delay, the delayed time lies between the last point and the present, and its value depends on both.
///
/// Prescribed motions are stored as pieces of their signals, exactly. The velocity of another node is stored at each step and
/// interpolated between discontinuities, with as many points as the integrator's highest order uses; the present is one of them
/// if needed. A discontinuity (a jump, a corner, an event) arrives again one delay later, and again after another delay: mostly
/// each time in a higher derivative, until it is too smooth to matter.
class DelayHistory {
 public:
  /// Besides the velocities of nodes it stores `channels` other values, as far back as `reach` [s]; discontinuities arrive
  /// again after each of `delays` [s]. No step may be longer than `limit` [s] (infinite: no limit). The present velocity of a
  /// node that is not `firm` (prescribed, or with a mass) is never used.
  DelayHistory(const Network& network, const std::vector<double>& delays, double reach, std::size_t channels, double limit,
       const std::vector<char>& firm);

  /// Whether there is anything to remember.
  bool any() const { return !tracks_.empty() || !channels_.empty(); }

  /// A delayed branch; `free_a` and `free_b` say which of its ends are no functions of time alone.
  struct Delayed { int branch; NodeId a, b; double delay; bool free_a, free_b; };
  const std::vector<Delayed>& delayed() const { return delayed_; }
  /// The number in `delayed` of a deflection branch of the network, -1 for others.
  int index_of(int branch) const { return index_of_[static_cast<std::size_t>(branch)]; }
  /// The longest step that needs no present values [s]; infinite if present values may always be used. A massless node would
  /// depend on itself at one time, which no error test sees: steps are then limited to a share of the delay, as below.
  double longest_step() const { return longest_step_; }
  /// The shortest delay of a quantity that is no function of time alone [s]; infinite if there is none.
  double shortest() const { return shortest_; }

  /// Jumps below this share of the largest value so far are ignored: the integrator's error leaves as much.
  void disregard(double share) { least_jump_ = share; }
  /// Before t = 0 all nodes have moved at these velocities (one for each node) [m/s].
  void begin(const std::vector<double>& velocity);
  /// Marks a discontinuity at t, where pieces of motions begin: a fresh one, or the arrival of an earlier one.
  void mark(double t, bool fresh);
  /// From t on motion number `m` of the network follows `piece`, a piece of its position or of its velocity.
  void follow(std::size_t m, double t, const Piece& piece, bool position);
  /// A value and its rate; NaN for an unknown rate.
  struct Known { double value, rate; };
  /// Stores the velocities of all nodes of the network at t: after a discontinuity, and after each step.
  void remember(double t, const std::vector<double>& velocity, const std::vector<Known>& channels);
  /// Stores the distances by which nodes jump at t [m].
  void moved(double t, const std::vector<double>& distance);

  /// Time of the next arrival of a discontinuity after the last one [s]; infinite if there is none.
  double next_break() const { return next_break_; }
  /// A value that depends on the present as `known + present * (value now)`; with rates.
  struct Felt { Dual known, present; };
  /// Velocity that branch number k of `delayed` feels at t [m/s]; its present part refers to the velocities of its free ends.
  Felt felt(std::size_t k, double t) const;
  /// Value and rate of a channel at t, seen from `now` [s]; `aside` is the offset, of the order of round-off, to the side of t
  /// that is meant [s].
  Felt channel(std::size_t k, double t, double aside, double now) const;
  /// Offset to the side of a discontinuity that is meant at t [s].
  double aside(double t) const;
  /// Jump of the displacement of branch number k as it feels it: all that has arrived by t since the last call [m].
  double take_steps(std::size_t k, double t);
  /// Number of points, pieces, steps and discontinuities stored: as many as the longest delay needs, and at most as many again.
  std::size_t held() const;

 private:
  struct Break { double t; int level; };       ///< level: how many delays it has come through
  struct Stretch { double t; Piece piece; bool position; };
  struct Point { double t, v, rate; };
  struct Run { double t; std::vector<Point> points; };  ///< between two discontinuities
  struct Curve { std::deque<Run> runs; double largest = 0; };
  struct Move { double t, distance; };
  struct Track {
    NodeId node;
    int motion = -1;
    double before = 0;  ///< velocity before t = 0
    std::deque<Stretch> stretches;
    Curve curve;
    std::deque<Move> moves;
  };
  Track* track(NodeId node);
  Felt velocity(NodeId node, double t, double aside, double now) const;  ///< on the piece in which t + aside lies
  static Felt look(const std::deque<Run>& runs, double t, double aside, double now, double before);
  struct Stencil { std::array<std::size_t, step_points> index{}; std::size_t count = 0; };
  static Stencil stencil(const std::vector<Point>& points, double t, double now, bool beyond);
  static Felt interpolate(const Run& run, double t, double now, bool last);
  /// Returns whether the value jumps at the beginning of a run.
  bool append(Curve& curve, double t, Known known) const;
  void forget(double t);
  void find_next_break();

  std::vector<Delayed> delayed_;
  std::vector<int> index_of_;   ///< of each deflection branch, -1
  std::vector<double> delays_;  ///< distinct delays, of branches and of blocks [s]
  std::vector<Track> tracks_;
  std::vector<Curve> channels_;
  std::vector<int> track_of_;   ///< of each node, -1
  std::vector<int> track_of_motion_;  ///< of each, -1
  std::deque<Break> breaks_;
  std::vector<double> taken_;  ///< of each delayed branch: time until which steps have been taken [s]
  double longest_step_, shortest_, longest_ = 0, least_jump_ = numerics::equal_values;
  double since_ = 0;           ///< the last discontinuity [s]
  double next_break_ = std::numeric_limits<double>::infinity();
};

}  // namespace rheonet
