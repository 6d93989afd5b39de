#pragma once

#include <ctime>

namespace rheonet {

/// CPU time of this thread alone [s], because simulations may run in parallel.
inline double cpu_seconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace rheonet
