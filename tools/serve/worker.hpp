#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

namespace rheonet::serve {

/// What a run may take.
struct Limits {
  double seconds;  ///< of CPU time
  int megabytes;
};

/// A process of its own that simulates, so that nothing in a scene can hang or kill the server. It takes a task, a line
/// of JSON, and answers with messages, a line each (see tools/report/messages.hpp); an empty line ends them.
class Worker {
 public:
  /// Starts one, which gets the open folder `folder` to read from; throws std::system_error.
  Worker(const Limits& limits, int folder);
  /// Kills it.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// False if it cannot take it.
  bool give(const std::string& task);

  enum class Answer { message, end, nothing, gone };
  /// Waits a while for the next message.
  Answer take(std::string& message, std::chrono::milliseconds patience);
  /// Bytes of a message that has not come whole yet.
  std::size_t begun() const { return buffer_.size() - begin_; }
  /// CPU time that it has used since it began [s]: waiting is free.
  double cpu_seconds() const;
  /// How it ended that has gone: for want of memory, or as these words say.
  struct Ending {
    bool of_memory;
    std::string words;
  };
  Ending ending();

  /// From now on it gets what others leave of the processors.
  void step_aside();
  bool is_aside() const { return aside_; }

 private:
  pid_t process_ = -1;
  int in_ = -1, out_ = -1;
  std::string buffer_;
  std::size_t begin_ = 0;     ///< of what has not been taken
  std::size_t searched_ = 0;  ///< before this there is no end of a line
  bool aside_ = false;
};

/// The process itself: takes tasks from standard input until there are no more. Its exit status is `out_of_memory` if a task
/// needs more than it may have.
constexpr int out_of_memory = 3;
/// File descriptor of the served folder in that process.
constexpr int folder_descriptor = 3;
int work(const Limits& limits);

}  // namespace rheonet::serve
