#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rheonet::test {

/// Bounds of a run of the program.
struct TrialLimits {
  double cpu_seconds = 0.05;     ///< CPU time after which the program gets SIGTERM [s].
  double answer_seconds = 2;     ///< CPU time within which it must end then [s].
  long megabytes = 2000;         ///< Memory limit [MB]; none with sanitizers that reserve the whole address space.
};

/// The outcome of a run of the program.
struct Trial {
  std::string fault;         ///< The failed check as text; "" if none failed.
  bool interrupted = false;  ///< The program exceeded its time and got SIGTERM.
  int status = 0;            ///< Exit status.
  std::string said;          ///< Text on standard error.
};

/// Runs the program's main function in a process of its own. `words` is its command line; the last word is the path of a file
/// that receives the netlist. The checks are those of README.md.
Trial try_program(const std::vector<std::string>& words, const std::string& netlist, const TrialLimits& limits);

/// Reads a netlist in this process. Returns the failed check as text ("refused without a message"); "" if none failed.
std::string try_read(const std::string& netlist, const std::filesystem::path& folder, const std::filesystem::path& library);

}  // namespace rheonet::test
