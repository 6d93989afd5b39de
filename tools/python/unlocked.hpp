#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>

namespace rheonet::python {

/// Releases the interpreter lock while it lives, as py::gil_scoped_release does, and ends well if the interpreter exits meanwhile: Python ends a
/// thread that asks for its lock then, by unwinding a stack that C++ cannot unwind. At exit the package sets the `interrupt` of every run and
/// waits until the threads have the lock again.
class Unlocked {
 public:
  class Exit;  ///< All threads that are without the lock, and whether the interpreter exits.

  /// `interrupt`: set to true if the interpreter exits. Throws SystemExit in a thread that begins while the interpreter exits.
  explicit Unlocked(std::atomic<bool>* interrupt = nullptr);
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  /// Calls `python` with the interpreter lock, in the thread that released it. Objects of C++ that own Python objects must not be on the stack
  /// of `python` while it runs Python code: that may be where the interpreter ends the thread.
  void with_lock(const std::function<void()>& python);

 private:
  std::atomic<bool>* interrupt_;
  PyThreadState* state_;
  bool calls_python_ = false;
};

/// Throws SystemExit if the interpreter exits, which ends this thread without a message.
void end_thread_at_exit();

/// Lets the interpreter wait at its exit for what runs without its lock.
void wait_at_exit();

}  // namespace rheonet::python
