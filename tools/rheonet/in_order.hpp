#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace rheonet::tool {

/// Tasks that each produce a text. They run in parallel; their texts are taken in order.
struct Tasks {
  long first = 0, end = 0;  ///< Numbers of the tasks: first .. end - 1.
  int jobs = 1;             ///< Number of threads.
  /// Produces the text of a task, on any thread. Returns nothing if it was stopped: `stop` becomes true when no more texts are wanted.
  std::function<std::optional<std::string>(long task, const std::atomic<bool>& stop)> make;
  /// Takes the texts in the order of the tasks, on the calling thread. Returns false to stop.
  std::function<bool(const std::string& text)> take;
  /// Called on the calling thread at intervals, with the number of finished tasks. Returns false to stop.
  std::function<bool(long done)> go_on;
};

/// Runs the tasks. Returns the number of the first task whose text was not taken, or `end`. An exception of a task stops all tasks and is
/// rethrown. Texts that wait for an earlier one take at most some hundred megabytes, plus the texts of the running tasks.
long do_in_order(const Tasks& tasks);

}  // namespace rheonet::tool
