#pragma once

#include <deque>
#include <limits>
#include <vector>

#include "core/dae/past.hpp"
#include "core/netlist/time_point.hpp"
#include "core/network/index.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// The blocks of a network at work: from what is known at an instant (functions of time, states, what sensors tell, the
/// past) to what each block puts out.
///
/// A limiter goes over from one side of its bounds to the other at events; in between it stays on its side, beyond the
/// bound too, so that what it puts out is smooth.
class BlockSignals {
 public:
  /// `classified` says which nodes have a velocity or position of their own, whatever the modes. Throws SimulationError
  /// where a force would follow from itself at one instant.
  BlockSignals(const Network& network, const Structure& classified);

  bool any() const { return !blocks_->blocks.empty(); }
  const Blocks& blocks() const { return *blocks_; }

  // --- The past.
  /// Delays of blocks [s], and how far back the longest way through several of them reaches [s].
  const std::vector<double>& delays() const { return delays_; }
  double reach() const { return reach_; }
  std::size_t channels() const { return channel_count_; }
  /// What the channels of the past hold now, where nodes have these velocities [m/s] and accelerations [m/s^2], the latter
  /// as far as masses have them.
  const std::vector<Past::Known>& remembered(const std::vector<double>& velocity, const std::vector<double>& acceleration);
  /// The longest step [s]: no delay is shorter that takes in what moves freely and that a prescribed motion follows from,
  /// as its acceleration must be known beforehand; nor one that takes in what no mass keeps from jumping.
  double longest_step() const { return longest_step_; }

  // --- Functions of time.
  /// Generators go over to the stretches that begin at t. Returns when the next of them ends [s].
  TimePoint enter(TimePoint t);
  /// A prescribed motion goes along `piece` from t on: its velocity, or position; `position` is where it is then [m].
  void follow(int motion, double t, const Piece& piece, bool by_position, double position);
  struct Generator { int element; const Signal* signal; const Piece* piece; };
  std::vector<Generator> generators() const;
  /// What generators and delays put out at t, and what sensors tell of prescribed motions, with rates.
  void evaluate_time(TimePoint t, const Past& past);
  /// What delays shorter than the time since the last step put out follows from the present too: anew, with the states
  /// and what sensors tell now. After `evaluate_time`, with the same `past`.
  void look_back(const Past& past);

  /// Whether a delay puts out something else just after t than just before, of functions of time alone: these nothing
  /// smoothes on their way.
  bool breaks(double t, const Past& past) const;

  // --- The rest of what is known, with rates.
  std::vector<Dual> state;   ///< of each block with a state, in the order of the blocks
  std::vector<Dual> sensed;  ///< of each sensor
  int state_of(int block) const { return state_of_[at(block)]; }
  std::size_t states() const { return state_blocks_.size(); }
  int block_of_state(std::size_t state) const { return state_blocks_[state]; }
  double initial(std::size_t k) const { return blocks_->blocks[at(state_blocks_[k])].law.initial; }

  /// All outputs. With `sides` limiters stay on the side that they are on; else they limit.
  void run(bool sides);
  Dual out(int block) const { return out_[at(block)]; }
  /// Rate of a state [unit/s].
  double rate(std::size_t k) const;

  // --- Derivatives of outputs and of rates of states by states and sensors: numbers of states first, then of sensors.
  std::size_t atoms() const { return state.size() + sensed.size(); }
  double slope(int block, std::size_t atom) const { return slope_[at(block) * atoms() + atom]; }
  double rate_slope(std::size_t k, std::size_t atom) const { return rate_slope_[k * atoms() + atom]; }
  /// Brings them up to date with what delays look back to in `past`.
  void update_slopes(const Past& past);
  /// Whether an output can depend on an atom at all, at the same instant.
  bool depends(int block, std::size_t atom) const { return depends_[at(block) * atoms() + atom] != 0; }
  /// The same of an output, or of the rate of a state, through delays shorter than a step as well.
  bool couples(int block, std::size_t atom) const { return couples_[at(block) * atoms() + atom] != 0; }
  bool couples(int block) const {
    for (std::size_t atom = 0; atom < atoms(); ++atom) {
      if (couples(block, atom)) return true;
    }
    return false;
  }
  bool rate_couples(std::size_t k, std::size_t atom) const { return rate_couples_[k * atoms() + atom] != 0; }

  // --- Limiters. Each bound that is finite has an event.
  struct Limit { int block; bool upper; };
  const std::vector<Limit>& limits() const { return limits_; }
  /// Positive as long as the limiter stays on its side [unit of the output].
  double event_function(std::size_t limit) const;
  /// These limits have been reached or left: the limiters go over, whatever rounding says.
  void fire(const std::vector<int>& limits);
  /// Limiters go to the sides that their inputs are on now, after `run(false)`.
  void choose();
  int side(int block) const { return side_[at(block)]; }

  /// States that stay as they are under the generators as they are. Throws SimulationError where there are none, or where
  /// they depend on how the network moves.
  void settle();

 private:
  struct Stretch { double t; Piece piece; bool by_position; double anchor; };
  static const Stretch* current(const std::deque<Stretch>& stretches, double t);
  void refuse_loops(const Network& network, const Structure& classified) const;
  void check_sensors(const Network& network, const Structure& classified) const;
  static bool loose(const Network& network, const Blocks::Sensor& sensor, const Structure& classified);
  void find_channels();
  double find_reach(int block) const;
  void take_in(const Blocks::Block& block, std::vector<char>& seen, std::vector<char>& atoms_of) const;
  bool of_time_alone(int block) const;
  void find_slopes(bool magnitudes, const std::vector<double>& of_delays, std::vector<double>& slope,
                   std::vector<double>& rate_slope) const;
  void find_dependence();
  bool feeds_motion(int block) const;
  void find_longest_step(const Network& network, const Structure& classified);
  Dual input(const Blocks::Block& block) const;
  Dual limited(const Blocks::Block& block, Dual v) const;
  /// A look back from `now` [s]. Derivatives are by time or, if it is not -1, by an atom as it is now.
  struct Look {
    const Past& past;
    double now, aside;
    int atom = -1;
    bool present = false;  ///< something that was found follows from the present
    Dual seen(double value, double rate) const { return atom < 0 ? Dual(value, rate) : Dual(value); }
  };
  Dual earlier(int block, double t, Look& look) const;
  Dual earlier_input(const Blocks::Block& block, double t, Look& look) const;
  Dual remembered_at(std::size_t atom, int channel, double t, Look& look) const;
  Dual motion_at(const Blocks::Sensor& sensor, const Stretch& stretch, double t) const;
  bool senses(int block, std::vector<char>& seen) const;
  double settle(int block, std::vector<char>& seen);
  [[noreturn]] void refuse_steady(int block, const char* why) const;

  const Network* network_;
  const Blocks* blocks_;
  std::vector<char> heavy_;  ///< of each sensor: it tells the velocity of a mass
  std::vector<int> state_of_;      ///< of each block, -1
  std::vector<int> state_blocks_;
  std::vector<double> delays_;
  double reach_ = 0, longest_step_ = std::numeric_limits<double>::infinity();
  std::vector<std::deque<Stretch>> generated_;  ///< of each block: the stretches of a generator, as far back as reach_
  std::vector<std::deque<Stretch>> moved_;      ///< of each sensor: those of a prescribed motion
  std::vector<int> state_channel_, sensor_channel_;
  std::size_t channel_count_ = 0;
  std::vector<Past::Known> remembered_;
  std::vector<Dual> out_, before_limits_;
  std::vector<signed char> side_;
  std::vector<Limit> limits_;
  struct Fired { int block; signed char side; };
  std::vector<Fired> fired_;
  std::vector<double> slope_, rate_slope_, delay_slope_;
  std::vector<char> depends_, couples_, rate_couples_;
  std::vector<char> present_;       ///< of each delay: it follows from the present too
  struct Pair { std::size_t delay, atom; };
  std::vector<Pair> pairs_;         ///< delays, and what they may follow from at present
  double now_ = 0, aside_ = 0;      ///< the time of the last `evaluate_time`, and the side of it that was meant [s]
  std::vector<double> before_run_;  ///< what each block has put out before the run, if that began in a steady state
};

}  // namespace rheonet
