#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "tools/rheonet/spool.hpp"

namespace rheonet::tool {

/// Tasks that each produce a text. They run in parallel; their texts are taken in order.
struct Tasks {
  long first = 0, end = 0;  ///< Numbers of the tasks: first .. end - 1.
  int jobs = 1;             ///< Number of threads.
  long most_at_once = 1;    ///< Consecutive tasks that a thread takes at once, while they are short.
  /// Produces the texts of the tasks first .. end - 1, of whole lines, on any thread. Returns false if it was stopped: `stop` becomes true when
  /// no more texts are wanted.
  std::function<bool(long first, long end, Spool& text, const std::atomic<bool>& stop)> make;
  /// Takes the texts in the order of the tasks, in pieces of whole lines, on the calling thread. Returns false to stop.
  std::function<bool(const std::string& lines)> take;
  /// Called on the calling thread at intervals, with the number of finished tasks. Returns false to stop.
  std::function<bool(long done)> go_on;
};

/// Runs the tasks. Returns the number of the first task whose text was not taken, or `end`. An exception of a task stops all tasks and is
/// rethrown. Memory grows neither with the texts nor with the number of tasks: long texts, and those that wait for an earlier task, are in a
/// temporary file, of at most some hundred megabytes besides the texts of the running tasks. Throws WriteError if it cannot be written.
long do_in_order(const Tasks& tasks);

}  // namespace rheonet::tool
