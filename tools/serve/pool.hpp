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

/// The shared memory limit of all answers that clients have not yet taken, so that slow or many clients cannot exhaust the memory.
class AnswerMemory {
 public:
  /// Changes the share of one answer from `held` to `wanted` bytes. Returns false, and changes nothing, if there is not enough left.
  bool change(std::size_t& held, std::size_t wanted);

  static constexpr std::size_t most = std::size_t{256} << 20U;  ///< Four answers of the largest size [bytes].

 private:
  std::mutex mutex_;
  std::size_t used_ = 0;
};

/// A pool of worker processes. At most `places` workers run at a time; further tasks wait in a queue. A run that uses much CPU time while
/// others wait steps aside: it gives up its place and continues at the lowest priority. So no task waits for a run that never ends.
class Pool {
 public:
  using Clock = std::chrono::steady_clock;

  /// `folder` is the descriptor of the folder that workers read from.
  Pool(const Limits& limits, std::size_t places, int folder);

  /// A worker with a place; nullptr if no place becomes free in time, or if `cancelled` returns true.
  std::unique_ptr<Worker> acquire(std::chrono::milliseconds patience, const std::function<bool()>& cancelled);

  /// Whether a run that has used `cpu_seconds` should step aside for waiting tasks. The more tasks wait, the less time it gets.
  bool is_in_the_way(double cpu_seconds);
  /// Gives up the worker's place. Returns false if too many have done so and the run has to end.
  bool step_aside(Worker& worker);

  /// Returns a worker to the pool. It is replaced if it is not `sound` (interrupted or terminated).
  void release(std::unique_ptr<Worker> worker, bool sound);
  const Limits& limits() const { return limits_; }
  AnswerMemory& answers() { return answers_; }

 private:
  std::unique_ptr<Worker> idle_or_new();

  Limits limits_;
  int folder_;
  AnswerMemory answers_;
  std::size_t places_, running_ = 0, aside_ = 0;
  std::deque<unsigned long> waiting_;  ///< Ticket numbers of the waiting tasks.
  unsigned long last_ = 0;             ///< Last ticket number issued.
  std::vector<std::unique_ptr<Worker>> idle_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace rheonet::serve
