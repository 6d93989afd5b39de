#pragma once

#include <array>
#include <deque>
#include <limits>
#include <vector>

#include "core/network/dual.hpp"
#include "core/dae/polynomial.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// How fast the ends of delayed branches have moved, for as long as the longest delay, and what else is felt later. Where a
/// step is longer than a delay, what is looked for lies between the last point and the present, and follows from both.
///
/// Prescribed motions are remembered by their stretches, exactly. Of other nodes the velocity is remembered at each step
/// and interpolated between breaks, over as many points as the integrator's highest order uses; the present is one of them
/// where it is needed. A break (a jump, a corner, an event) comes again one delay later, and once more after that: mostly
/// each time in a higher derivative, until it is too smooth to matter.
class Past {
 public:
  /// Besides the velocities of nodes it remembers `channels` other values, as far back as `reach`; what breaks comes again
  /// after each of `delays` [s]. No step may be longer than `limit` [s] (infinite: none of them limits it). Of nodes
  /// that are not `firm` (prescribed, or with a mass) the present is not looked for.
  Past(const Network& network, const std::vector<double>& delays, double reach, std::size_t channels, double limit,
       const std::vector<char>& firm);

  /// Whether there is anything to remember.
  bool any() const { return !tracks_.empty() || !channels_.empty(); }

  /// A delayed branch; `free` says which of its ends are no function of time alone.
  struct Delayed { int branch; NodeId a, b; double delay; bool free_a, free_b; };
  const std::vector<Delayed>& delayed() const { return delayed_; }
  /// The number in `delayed` of a deflection branch of the network, -1 for others.
  int index_of(int branch) const { return index_of_[static_cast<std::size_t>(branch)]; }
  /// The longest step [s] where the present is not looked for; infinite where it always is. What has no mass would follow from
  /// itself at one instant, and no error test sees it: then a step is a share of the delay, as below.
  double longest_step() const { return longest_step_; }
  /// A step in so many delays leaves three points on either side of what is looked for: interpolated in the middle of them no
  /// oscillation from step to step is magnified, which near their end it is, and by what feels it again and again.
  static constexpr double steps_in_delay = 3;
  /// The shortest delay of what is no function of time alone [s]; infinite if there is none.
  double shortest() const { return shortest_; }

  /// A jump of less than this share of the largest value so far is none: an integrator's error leaves as much.
  void disregard(double share) { least_jump_ = share; }
  /// Until t = 0 all nodes have moved at these velocities (one for each node) [m/s].
  void begin(const std::vector<double>& velocity);
  /// A break at t, and the stretches of the motions that begin there. It is a fresh one, or comes of one a delay ago.
  void mark(double t, bool fresh);
  /// From t on motion number `m` of the network moves along `piece`, the stretch of its position or of its velocity.
  void follow(std::size_t m, double t, const Piece& piece, bool position);
  /// A value and how fast it changes; NaN for a rate that is not known.
  struct Known { double value, rate; };
  /// The nodes (all of the network) have these velocities at t: after a break, and after each step.
  void remember(double t, const std::vector<double>& velocity, const std::vector<Known>& channels);
  /// At t the nodes have moved by these distances in no time [m].
  void moved(double t, const std::vector<double>& distance);

  /// The next instant after the last break at which something comes through [s]; infinite if there is none.
  double next_break() const { return next_break_; }
  /// What depends on the present as `known + present * (what it is now)`; with rates.
  struct Felt { Dual known, present; };
  /// What branch number k of `delayed` feels at t [m/s]; of the present it needs the velocities of its free ends.
  Felt felt(std::size_t k, double t) const;
  /// What a channel was at t, and its rate, if it is `now` [s]; `aside` as far as rounding goes to the side of t that is
  /// meant [s].
  Felt channel(std::size_t k, double t, double aside, double now) const;
  /// To which side of a break it counts now that t is looked at [s].
  double aside(double t) const;
  /// By how much its ends have come apart in no time, as it feels it: what has come through by t since it was last asked [m].
  double take_steps(std::size_t k, double t);
  /// How many points, stretches, steps and breaks are remembered at present. What the longest delay needs, and no more than as
  /// much again.
  std::size_t held() const;

 private:
  struct Break { double t; int level; };       ///< level: how often it has come through a delay
  struct Stretch { double t; Piece piece; bool position; };
  struct Point { double t, v, rate; };
  struct Run { double t; std::vector<Point> points; };  ///< between two breaks
  struct Curve { std::deque<Run> runs; double largest = 0; };
  struct Move { double t, distance; };
  struct Track {
    NodeId node;
    int motion = -1;
    double before = 0;  ///< velocity until t = 0
    std::deque<Stretch> stretches;
    Curve curve;
    std::deque<Move> moves;
  };
  Track* track(NodeId node);
  Felt velocity(NodeId node, double t, double aside, double now) const;  ///< of the stretch that t + aside lies in
  static Felt look(const std::deque<Run>& runs, double t, double aside, double now, double before);
  struct Stencil { std::array<std::size_t, step_points> index{}; std::size_t count = 0; };
  static Stencil stencil(const std::vector<Point>& points, double t, double now, bool beyond);
  static Felt interpolate(const Run& run, double t, double now, bool last);
  /// Returns whether the value jumps where a run begins.
  bool append(Curve& curve, double t, Known known) const;
  void forget(double t);
  void find_next_break();

  std::vector<Delayed> delayed_;
  std::vector<int> index_of_;   ///< of each deflection branch, -1
  std::vector<double> delays_;  ///< those that there are, of branches and of blocks, each once [s]
  std::vector<Track> tracks_;
  std::vector<Curve> channels_;
  std::vector<int> track_of_;   ///< of each node, -1
  std::vector<int> track_of_motion_;  ///< of each, -1
  std::deque<Break> breaks_;
  std::vector<double> taken_;  ///< of each delayed branch: up to when steps have been taken [s]
  double longest_step_, shortest_, longest_ = 0, least_jump_ = 1e-12;
  double since_ = 0;           ///< the last break [s]
  double next_break_ = std::numeric_limits<double>::infinity();
};

}  // namespace rheonet
