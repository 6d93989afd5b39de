#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "tools/serve/worker.hpp"

namespace rheonet::serve {

/// Workers that are ready: as many as run at once, the others wait their turn.
class Pool {
 public:
  Pool(const Limits& limits, std::size_t size);

  /// A worker; nullptr if none becomes free in time or `cancelled` says that it is no longer wanted.
  template <class Cancelled>
  std::unique_ptr<Worker> acquire(std::chrono::milliseconds patience, Cancelled cancelled) {
    using namespace std::chrono_literals;
    const auto until = std::chrono::steady_clock::now() + patience;
    std::unique_lock lock(mutex_);
    while (busy_ == size_) {
      if (cancelled() || std::chrono::steady_clock::now() >= until) return nullptr;
      freed_.wait_for(lock, 50ms);
    }
    ++busy_;
    return take_idle(lock);
  }

  /// Gives one back; one that is not `sound` (it was interrupted, or has gone) is replaced.
  void release(std::unique_ptr<Worker> worker, bool sound);
  const Limits& limits() const { return limits_; }

 private:
  std::unique_ptr<Worker> take_idle(std::unique_lock<std::mutex>& lock);

  Limits limits_;
  std::size_t size_, busy_ = 0;
  std::vector<std::unique_ptr<Worker>> idle_;
  std::mutex mutex_;
  std::condition_variable freed_;
};

}  // namespace rheonet::serve
