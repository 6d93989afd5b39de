#pragma once

#include <functional>
#include <string>
#include <vector>

namespace rheonet::test {

/// Calls work(number) for each number in a separate process, up to `jobs` at a time, and done(number, result) in this process with the
/// returned value, in any order. If a process crashes or uses more than `seconds` of CPU time, the result is that of lost(number, why);
/// the other processes are not affected.
struct Apart {
  std::function<std::string(int number)> work;
  std::function<void(int number, const std::string& result)> done;
  std::function<void(int number, const std::string& why)> lost;
  int jobs = 1;
#if defined(__SANITIZE_ADDRESS__)
  int seconds = 400;  // Sanitizers take seven times as long.
#else
  int seconds = 60;  // A scene takes a fraction of a second, the slowest a few seconds.
#endif

  void run(const std::vector<int>& numbers) const;
};

}  // namespace rheonet::test
