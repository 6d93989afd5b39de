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

/// A task on its way: a worker's messages are gathered as they come, whether or not the client takes them, so that a
/// client that is slow keeps no worker from others.
class Job {
 public:
  Job(Pool& pool, std::string task);
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Ends it: nobody wants its result any more.
  void cancel() { cancelled_ = true; }

  /// What has come since the last time, after waiting a while for it; `finished` if nothing more will.
  std::string take(std::chrono::milliseconds patience, bool& finished);

 private:
  void run();
  /// A worker that has taken the task; nullptr if there is none, which has then been said.
  std::unique_ptr<Worker> begin();
  /// The worker's answer, up to its end. Whether the worker can go on with another task.
  bool follow(Worker& worker);
  /// Whether the run is to end for what it takes, which has then been said.
  bool is_too_much(Worker& worker, Pool::Clock::time_point began, double cpu_before);
  void tell(const std::string& message);
  void fail(const std::string& why);
  /// Says to AnswerMemory how much this answer holds, with so much that a worker has begun to send. False: there is no room.
  bool hold(std::size_t begun);

  Pool& pool_;
  std::string task_;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
  std::condition_variable more_;
  std::string text_;       ///< not taken yet
  std::size_t given_ = 0;  ///< bytes that were taken last, and are being sent
  std::size_t begun_ = 0;  ///< bytes that a worker has begun to send
  std::size_t held_ = 0;   ///< bytes of AnswerMemory
  std::size_t told_ = 0;   ///< bytes in all
  bool finished_ = false;
  std::thread thread_;
};

}  // namespace rheonet::serve
