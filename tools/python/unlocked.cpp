#include "tools/python/unlocked.hpp"

#include <cxxabi.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace py = pybind11;

namespace rheonet::python {
namespace {

/// Longest wait at exit for a function `progress`, which may itself wait for something that the exiting program no longer does.
constexpr auto longest_wait_for_python = std::chrono::seconds(1);

[[noreturn]] void sleep_until_the_process_ends() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Takes the lock. A thread that Python would end sleeps instead: its stack cannot be unwound, and may not be left.
void take_lock(PyThreadState* state) {
  try {
    PyEval_RestoreThread(state);
  } catch (abi::__forced_unwind&) {
    sleep_until_the_process_ends();
  }
}

}  // namespace

class Unlocked::Exit {
 public:
  static Exit& instance() {
    static Exit& exit = *new Exit;  // never destroyed: sleeping threads may outlive main()
    return exit;
  }

  /// Whether the interpreter exits, and this is not the thread that ends it.
  bool ends_this_thread() {
    const std::lock_guard lock(mutex_);
    return ending_ && std::this_thread::get_id() != ended_by_;
  }

  void add(Unlocked* unlocked) {
    const std::lock_guard lock(mutex_);
    unlocked_.push_back(unlocked);
    if (ending_ && unlocked->interrupt_ && std::this_thread::get_id() != ended_by_) *unlocked->interrupt_ = true;
  }

  void remove(Unlocked* unlocked) {
    {
      const std::lock_guard lock(mutex_);
      std::erase(unlocked_, unlocked);
    }
    changed_.notify_all();
  }

  void set_calls_python(Unlocked& unlocked, bool calls) {
    bool too_late = false;
    {
      const std::lock_guard lock(mutex_);
      unlocked.calls_python_ = calls;
      too_late = !calls && waited_ && std::this_thread::get_id() != ended_by_;
    }
    changed_.notify_all();
    if (too_late) sleep_until_the_process_ends();
  }

  void end_all() {
    PyThreadState* const state = PyEval_SaveThread();
    {
      std::unique_lock lock(mutex_);
      ending_ = true;
      ended_by_ = std::this_thread::get_id();
      for (Unlocked* unlocked : unlocked_)
        if (unlocked->interrupt_) *unlocked->interrupt_ = true;
      changed_.wait_for(lock, longest_wait_for_python, [this] { return unlocked_.empty(); });
      changed_.wait(lock, [this] { return std::all_of(unlocked_.begin(), unlocked_.end(), [](Unlocked* u) { return u->calls_python_; }); });
      waited_ = true;
    }
    PyEval_RestoreThread(state);
  }

 private:
  Exit() {
    // A forked process has none of the other threads.
    pthread_atfork([] { instance().mutex_.lock(); }, [] { instance().mutex_.unlock(); },
                   [] {
                     instance().unlocked_.clear();
                     instance().mutex_.unlock();
                   });
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Unlocked*> unlocked_;
  bool ending_ = false;
  bool waited_ = false;  ///< The interpreter goes on to exit, without waiting for further threads.
  std::thread::id ended_by_;
};

Unlocked::Unlocked(std::atomic<bool>* interrupt) : interrupt_(interrupt) {
  end_thread_at_exit();
  Exit::instance().add(this);
  state_ = PyEval_SaveThread();
}

Unlocked::~Unlocked() {
  take_lock(state_);
  Exit::instance().remove(this);
}

void Unlocked::with_lock(const std::function<void()>& python) {
  Exit::instance().set_calls_python(*this, true);
  take_lock(state_);
  try {
    python();
  } catch (abi::__forced_unwind&) {
    sleep_until_the_process_ends();
  }
  state_ = PyEval_SaveThread();
  Exit::instance().set_calls_python(*this, false);
}

void end_thread_at_exit() {
  if (!Unlocked::Exit::instance().ends_this_thread()) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

void wait_at_exit() {
  py::module_::import("atexit").attr("register")(py::cpp_function([] { Unlocked::Exit::instance().end_all(); }));
}

}  // namespace rheonet::python
