#include "tools/rheonet/in_order.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace rheonet::tool {
namespace {

constexpr std::size_t most_waiting = 256 << 20;             // Size of the waiting texts, on disk [bytes].
constexpr std::chrono::milliseconds longest_wait{100};      // Delay of the response to an interrupt.
constexpr std::chrono::milliseconds short_time{10};         // Tasks that take less than this together are short.
constexpr std::chrono::milliseconds between_notices{10};    // A wake-up takes about a tenth of the time of a short run.

class InOrder {
 public:
  explicit InOrder(const Tasks& tasks) : tasks_(tasks), next_(tasks.first), taken_(tasks.first) {}

  long run() {
    {
      std::vector<std::jthread> workers;
      for (long k = 0; k < std::min<long>(tasks_.jobs, tasks_.end - tasks_.first); ++k)
        workers.emplace_back([this] { work(); });
      try {
        while (!stop_ && taken_ < tasks_.end) {
          if (!take_ready() || !tasks_.go_on(done_)) end();
        }
      } catch (...) {
        end();  // Stops the workers.
        throw;
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
    for (long count = 1;;) {
      long first = 0, end = 0;
      {
        std::unique_lock lock(mutex_);
        // No deadlock: the task whose text is to be taken next has been started, unless no text waits.
        room_.wait(lock, [this] { return stop_ || bytes_ < most_waiting; });
        if (stop_ || next_ >= tasks_.end) return;
        first = next_;
        // At the end the tasks are shared among all threads.
        end = next_ += std::clamp((tasks_.end - next_) / (2L * tasks_.jobs), 1L, count);
      }
      const auto begin = std::chrono::steady_clock::now();
      try {
        Spool text(file_);
        if (!tasks_.make(first, end, text, stop_)) continue;
        const auto now = std::chrono::steady_clock::now();
        count = now - begin < short_time ? std::min(2 * count, tasks_.most_at_once) : std::max(count / 2, 1L);
        const std::scoped_lock lock(mutex_);
        add(first, end, std::move(text));
        done_ += end - first;
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

  /// Adds the text of tasks, and joins it with those of the tasks before and after them: there is never more than one gap for each thread, so
  /// few texts wait.
  void add(long first, long end, Spool text) {
    bytes_ += text.size();
    auto after = waiting_.lower_bound(end);
    if (after != waiting_.begin())
      if (const auto before = std::prev(after); before->second.end == first) {
        first = before->first;
        before->second.text.append(std::move(text));
        text = std::move(before->second.text);
        waiting_.erase(before);
      }
    if (after != waiting_.end() && after->first == end) {
      end = after->second.end;
      text.append(std::move(after->second.text));
      waiting_.erase(after);
    }
    waiting_.emplace(first, Texts{end, std::move(text)});
  }

  /// Takes the next texts if there are some within `longest_wait`. Returns false to stop.
  bool take_ready() {
    std::unique_lock lock(mutex_);
    ready_.wait_for(lock, longest_wait, [this] { return waiting_.contains(taken_) || stop_; });
    auto next = waiting_.extract(taken_);
    if (next.empty()) return true;
    Texts& texts = next.mapped();
    bytes_ -= texts.text.size();
    lock.unlock();
    room_.notify_all();
    if (!texts.text.take(tasks_.take)) return false;
    lock.lock();
    taken_ = texts.end;
    return true;
  }

  void end() {
    {
      const std::scoped_lock lock(mutex_);
      stop_ = true;
    }
    room_.notify_all();
  }

  /// The texts of consecutive tasks.
  struct Texts {
    long end = 0;  ///< Behind the last task.
    Spool text;
  };

  const Tasks& tasks_;
  SpoolFile file_;
  std::mutex mutex_;
  std::condition_variable ready_, room_;
  std::map<long, Texts> waiting_;  ///< Texts that are not taken yet, by their first task.
  std::size_t bytes_ = 0;          ///< Size of the waiting texts.
  long next_;                      ///< Next task to start.
  long taken_;                     ///< Next task whose text is to be taken.
  std::atomic<long> done_ = 0;
  std::atomic<bool> stop_ = false;
  std::exception_ptr failure_;
  std::chrono::steady_clock::time_point last_notice_;  ///< To the thread that takes the texts.
};

}  // namespace

long do_in_order(const Tasks& tasks) { return InOrder(tasks).run(); }

}  // namespace rheonet::tool
