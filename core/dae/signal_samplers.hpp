#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "core/netlist/time_point.hpp"
#include "core/network/network.hpp"

namespace rheonet {

/// The blocks of a network that sample: each holds its input as it was at the last multiple of its period.
class SignalSamplers {
 public:
  explicit SignalSamplers(const Network& network);

  bool any() const { return !samplers_.empty(); }
  bool samples(int block) const { return !of_.empty() && of_[static_cast<std::size_t>(block)] >= 0; }

  /// Samples that are due at t begin. Returns the time of the next one [s].
  TimePoint enter(double t);
  std::vector<int> due(double t) const;  ///< Blocks with a sample at t.
  /// A sample has begun, and follows the input until `hold`.
  bool follows_input(int block) const { return sampler(block).taking; }
  /// The last sample.
  double value(int block) const { return sampler(block).value; }
  /// The sample that was held at a time, which `reach` of `hold` still covers [s].
  double value(int block, double t) const;

  /// Gives the sample that a block would take now: its present input, rounded to its quantum.
  using Sample = std::function<double(int block)>;
  /// Samples that have begun take their input as it is now, which may jump at the same time: until `hold` they can be taken again.
  void take(const Sample& sample);
  /// Ends that at time `now`. Returns false, and ends nothing, if an input has jumped by more than round-off since its sample was taken.
  /// `round`: how many calls at this time came before; once there were as many as samplers, it holds in any case. Samples older than
  /// `reach` are forgotten [s].
  bool hold(std::size_t round, double now, double reach, const Sample& sample);

 private:
  struct Taken { double t, value; };
  struct Sampler {
    int block;
    double period;            ///< s
    double number;            ///< A whole number: the last sample was at the first time not before this multiple of the period.
    TimePoint next;           ///< Time of the next sample; at first the start.
    bool taking = false;      ///< A sample is due, and still follows the input.
    double value = 0;         ///< The last sample.
    double largest = 0;       ///< Magnitude of the samples so far.
    std::deque<Taken> taken;  ///< Samples, as far back as `reach`.
  };
  const Sampler& sampler(int block) const { return samplers_[static_cast<std::size_t>(of_[static_cast<std::size_t>(block)])]; }

  double start_;          ///< Time in the scene at which the run begins [s].
  std::vector<int> of_;   ///< For each block: index into samplers_, or -1.
  std::vector<Sampler> samplers_;
};

}  // namespace rheonet
