#pragma once

#include <chrono>

namespace rheonet::tool {

/// A bar on standard error with the time that is left. It shows itself only on a terminal, only when a run is long
/// enough to wonder about, and is gone at the end.
class Progress {
 public:
  explicit Progress(bool wanted);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of the work is done, 0 to 1. May be called at every step.
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
