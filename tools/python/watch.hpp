#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <thread>

#include "tools/python/unlocked.hpp"

namespace rheonet::python {

namespace py = pybind11;

/// Interval at which signals (Ctrl-C) are checked and `progress` is called: short for a person.
inline constexpr auto polling_interval = std::chrono::milliseconds(20);

/// Checks for signals and calls `progress` during a run, at intervals. An exception (KeyboardInterrupt) ends the run.
class Watch {
 public:
  /// `progress` is called with the fraction of the run completed, unless it is None.
  explicit Watch(const py::object& progress) : progress_(progress) {}

  const std::atomic<bool>* interrupt() const { return &interrupt_; }

  /// For RunSettings::progress. The engine may call it in any thread, but Python delivers signals to its main thread only: so the
  /// thread that made the Watch is the one that looks.
  void advance(double fraction) {
    fraction_ = fraction;
    if (std::this_thread::get_id() == caller_ && std::chrono::steady_clock::now() - last_ > polling_interval) look();
  }

  /// Calls `work` without the interpreter lock. `aside`: in another thread, while this one only watches, as is necessary if the
  /// engine has several threads or does not call `advance` often. Throws what ended the run: SystemExit if the interpreter exits.
  void call(const std::function<void()>& work, bool aside) {
    {
      Unlocked unlocked(&interrupt_);
      unlocked_ = &unlocked;
      if (aside) {
        std::future<void> done = std::async(std::launch::async, work);
        while (done.wait_for(polling_interval) == std::future_status::timeout) look();
        done.get();
      } else {
        work();
      }
      if (told_ && !stopped_) {  // A display of the progress ends with all of it.
        fraction_ = 1;
        look();
      }
    }
    if (stopped_) std::rethrow_exception(stopped_);
    end_thread_at_exit();
  }

 private:
  void look() {
    if (stopped_) return;
    last_ = std::chrono::steady_clock::now();
    unlocked_->with_lock([this] {
      const bool goes_on = PyErr_CheckSignals() == 0 && tell();
      if (goes_on) return;
      stopped_ = std::make_exception_ptr(py::error_already_set());
      interrupt_ = true;
    });
  }

  /// Calls `progress`, with the functions of C as Unlocked::with_lock asks for. False if it raises an exception.
  bool tell() {
    if (progress_.is_none()) return true;
    told_ = true;
    PyObject* const returned = PyObject_CallFunction(progress_.ptr(), "d", fraction_.load());
    Py_XDECREF(returned);
    return returned != nullptr;
  }

  const py::object& progress_;
  const std::thread::id caller_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::atomic<bool> interrupt_ = false;
  std::atomic<double> fraction_ = 0;
  std::exception_ptr stopped_;
  bool told_ = false;  ///< `progress` has been called.
  Unlocked* unlocked_ = nullptr;
};

}  // namespace rheonet::python
