#include "tools/rheonet/in_order.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace rheonet::tool {
namespace {

constexpr std::size_t most_waiting = 256 << 20;             // Size of the waiting texts [bytes].
constexpr std::chrono::milliseconds longest_wait{100};      // Delay of the response to an interrupt.
constexpr std::chrono::milliseconds between_notices{10};    // A wake-up takes about a tenth of the time of a short run.

class InOrder {
 public:
  explicit InOrder(const Tasks& tasks) : tasks_(tasks), next_(tasks.first), taken_(tasks.first) {}

  long run() {
    {
      std::vector<std::jthread> workers;
      for (long k = 0; k < std::min<long>(tasks_.jobs, tasks_.end - tasks_.first); ++k)
        workers.emplace_back([this] { work(); });
      while (!stop_ && taken_ < tasks_.end) {
        if (!take_ready() || !tasks_.go_on(done_)) end();
      }
      end();
    }
    if (failure_) std::rethrow_exception(failure_);
    // Take the texts that were finished before the stop.
    while (waiting_.contains(taken_) && take_ready()) {
    }
    return taken_;
  }

 private:
  void work() {
    for (;;) {
      long task = 0;
      {
        std::unique_lock lock(mutex_);
        // No deadlock: the task whose text is to be taken next has been started, unless no text waits.
        room_.wait(lock, [this] { return stop_ || bytes_ < most_waiting; });
        if (stop_ || next_ >= tasks_.end) return;
        task = next_++;
      }
      try {
        auto text = tasks_.make(task, stop_);
        if (!text) continue;
        const std::scoped_lock lock(mutex_);
        bytes_ += text->size();
        waiting_.emplace(task, std::move(*text));
        ++done_;
        const auto now = std::chrono::steady_clock::now();
        if (now - last_notice_ < between_notices && done_ < tasks_.end - tasks_.first) continue;
        last_notice_ = now;
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        stop_ = true;
      }
      ready_.notify_one();
    }
  }

  /// Takes the next text if it is ready within `longest_wait`. Returns false to stop.
  bool take_ready() {
    std::unique_lock lock(mutex_);
    ready_.wait_for(lock, longest_wait, [this] { return waiting_.contains(taken_) || stop_; });
    for (auto next = waiting_.find(taken_); next != waiting_.end(); next = waiting_.find(taken_)) {
      const std::string text = std::move(next->second);
      waiting_.erase(next);
      bytes_ -= text.size();
      lock.unlock();
      room_.notify_all();
      if (!tasks_.take(text)) return false;
      lock.lock();
      ++taken_;
    }
    return true;
  }

  void end() {
    {
      const std::scoped_lock lock(mutex_);
      stop_ = true;
    }
    room_.notify_all();
  }

  const Tasks& tasks_;
  std::mutex mutex_;
  std::condition_variable ready_, room_;
  std::map<long, std::string> waiting_;  ///< Texts that are not taken yet.
  std::size_t bytes_ = 0;                ///< Size of the waiting texts.
  long next_;                            ///< Next task to start.
  long taken_;                           ///< Next task whose text is to be taken.
  std::atomic<long> done_ = 0;
  std::atomic<bool> stop_ = false;
  std::exception_ptr failure_;
  std::chrono::steady_clock::time_point last_notice_;  ///< To the thread that takes the texts.
};

}  // namespace

long do_in_order(const Tasks& tasks) { return InOrder(tasks).run(); }

}  // namespace rheonet::tool
