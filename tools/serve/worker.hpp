#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

namespace rheonet::serve {

/// Resource limits of a run.
struct Limits {
  double seconds;  ///< CPU time [s].
  int megabytes;   ///< Memory [MB].
};

/// A separate process that simulates, so that no scene can hang or kill the server. It takes a task as a line of JSON and answers with
/// messages, one a line (see tools/report/messages.hpp), and an empty line at the end.
class Worker {
 public:
  /// Starts the process, which inherits the folder descriptor `folder`. Throws std::system_error.
  Worker(const Limits& limits, int folder);
  /// Kills the process.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Sends a task. Returns false if the process has ended.
  bool give(const std::string& task);

  enum class Answer { message, end, nothing, gone };
  /// Waits up to `patience` for the next message.
  Answer take(std::string& message, std::chrono::milliseconds patience);
  /// Size of the incomplete message received so far [bytes].
  std::size_t begun() const { return buffer_.size() - begin_; }
  /// CPU time of the process since its start [s].
  double cpu_seconds() const;
  /// How the process ended: out of memory, or as `words` describe.
  struct Ending {
    bool of_memory;
    std::string words;
  };
  Ending ending();

  /// Sets the lowest scheduling priority.
  void step_aside();
  bool is_aside() const { return aside_; }

 private:
  pid_t process_ = -1;
  int in_ = -1, out_ = -1;
  std::string buffer_;
  std::size_t begin_ = 0;     ///< Begin of the text not taken yet.
  std::size_t searched_ = 0;  ///< There is no line feed between begin_ and here.
  bool aside_ = false;
};

/// The main function of the process: takes tasks from standard input until its end. The exit status is `out_of_memory` if a task exceeds
/// the memory limit.
constexpr int out_of_memory = 3;
/// File descriptor of the served folder in that process.
constexpr int folder_descriptor = 3;
int work(const Limits& limits);

}  // namespace rheonet::serve
