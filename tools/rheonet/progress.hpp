#pragma once

#include <chrono>

namespace rheonet::tool {

/// A progress bar on standard error with the remaining time. It appears only on a terminal, only in runs longer than half a second, and
/// is erased at the end.
class Progress {
 public:
  explicit Progress(bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets the fraction of the work that is done, 0 to 1. May be called at every step.
  void update(double fraction);
  /// Removes the bar, so that a message can be printed.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace rheonet::tool
