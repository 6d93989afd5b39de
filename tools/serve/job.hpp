#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "tools/serve/pool.hpp"

namespace rheonet::serve {

/// A running task. The worker's messages are collected as they arrive, whether or not the client takes them, so that a slow client does not
/// block a worker.
class Job {
 public:
  Job(Pool& pool, std::string task);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Ends the task; its result is no longer wanted.
  void cancel() { cancelled_ = true; }

  /// The messages since the last call; waits up to `patience` for some. Sets `finished` if no more will follow.
  std::string take(std::chrono::milliseconds patience, bool& finished);

 private:
  void run();
  /// A worker that has accepted the task; nullptr, after a message `failed`, if there is none.
  std::unique_ptr<Worker> begin();
  /// Collects the worker's answer up to its end. Returns whether the worker can take another task.
  bool follow(Worker& worker);
  /// Whether the run exceeds a limit and must end; sends the message then.
  bool is_too_much(Worker& worker, Pool::Clock::time_point began, double cpu_before);
  void tell(const std::string& message);
  void fail(const std::string& why);
  /// Updates this answer's share of AnswerMemory, including `begun` bytes of an incomplete message. Returns false if there is no room.
  bool hold(std::size_t begun);

  Pool& pool_;
  std::string task_;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::condition_variable more_;
  std::string text_;       ///< Messages not yet taken.
  std::size_t given_ = 0;  ///< Bytes that were taken last and are being sent.
  std::size_t begun_ = 0;  ///< Bytes of the worker's incomplete message.
  std::size_t held_ = 0;   ///< Bytes reserved in AnswerMemory.
  std::size_t told_ = 0;   ///< Bytes in all messages so far.
  bool finished_ = false;
  std::thread thread_;
};

}  // namespace rheonet::serve
