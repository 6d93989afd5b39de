#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace rheonet::tool {

/// Tasks that each make a text, done side by side, and taken in their order.
struct Tasks {
  long first = 0, end = 0;  ///< numbers of the tasks: first .. end - 1
  int jobs = 1;             ///< at a time
  /// Makes the text of a task, on any thread. Nothing if it was stopped: `stop` becomes true when no more is wanted.
  std::function<std::optional<std::string>(long task, const std::atomic<bool>& stop)> make;
  /// Takes a text, on the calling thread, the first task's first. False: no more is wanted.
  std::function<bool(const std::string& text)> take;
  /// Is called on the calling thread now and then, with the number of tasks that are done. False: no more is wanted.
  std::function<bool(long done)> go_on;
};

/// Does them; the number of the first whose text was not taken, `end` if all are. What a task throws ends all, and is thrown
/// on. Texts that wait for an earlier one take some hundreds of megabytes at most, and those under way.
long do_in_order(const Tasks& tasks);

}  // namespace rheonet::tool
