#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "tools/serve/worker.hpp"

namespace rheonet::serve {

/// Memory that all answers share which nobody has taken yet: a client that is slow, or many, must not fill the machine's.
class AnswerMemory {
 public:
  /// Changes what one answer holds from `held` to `wanted` bytes. False, and no change, if there is not so much left.
  bool change(std::size_t& held, std::size_t wanted);

  static constexpr std::size_t most = std::size_t{256} << 20U;  ///< bytes: four of the largest answers

 private:
  std::mutex mutex_;
  std::size_t used_ = 0;
};

/// Workers that are ready, and who may use them: as many run at once as there are places, the others wait their turn, first
/// come, first served. A run that uses much CPU time while others wait steps aside: it goes on with what they leave of the
/// processors, and has no place among those that run. So nobody waits for runs that never end.
class Pool {
 public:
  using Clock = std::chrono::steady_clock;

  /// `folder` is open, and what workers read from.
  Pool(const Limits& limits, std::size_t places, int folder);

  /// A worker with a place; nullptr if it is not its turn in time, or `cancelled` says that it is no longer wanted.
  std::unique_ptr<Worker> acquire(std::chrono::milliseconds patience, const std::function<bool()>& cancelled);

  /// Whether others wait for the place of a run that has used so much CPU time: the more of them, the sooner.
  bool is_in_the_way(double cpu_seconds);
  /// Gives up its place to them; false if too many have done so, and it has to end.
  bool step_aside(Worker& worker);

  /// Gives a worker back, which did or did not step aside; one that is not `sound` (it was interrupted, or has gone) is
  /// replaced.
  void release(std::unique_ptr<Worker> worker, bool sound);
  const Limits& limits() const { return limits_; }
  AnswerMemory& answers() { return answers_; }

 private:
  std::unique_ptr<Worker> idle_or_new();

  Limits limits_;
  int folder_;
  AnswerMemory answers_;
  std::size_t places_, running_ = 0, aside_ = 0;
  std::deque<unsigned long> waiting_;  ///< the numbers of those that wait
  unsigned long last_ = 0;             ///< number that was given
  std::vector<std::unique_ptr<Worker>> idle_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace rheonet::serve
