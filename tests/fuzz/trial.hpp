#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rheonet::test {

/// Bounds of a run of the program.
struct TrialLimits {
  double cpu_seconds = 0.05;     ///< after this it is sent SIGTERM
  double answer_seconds = 2;     ///< of CPU time, within which it has to end then
  long megabytes = 2000;         ///< of memory; without a bound where sanitizers take all addresses
};

/// The outcome of a run of the program.
struct Trial {
  std::string fault;         ///< the check that failed, in words; "" if none did
  bool interrupted = false;  ///< it took longer than it may, and was sent SIGTERM
  int status = 0;            ///< exit status
  std::string said;          ///< on standard error
};

/// Runs the program's main function in a process of its own. `words` is its command line; the last word is the path of a file
/// that receives the netlist. The checks are those of README.md.
Trial try_program(const std::vector<std::string>& words, const std::string& netlist, const TrialLimits& limits);

/// Reads a netlist in this process. The check that failed, in words ("refused without a message"); "" if none did.
std::string try_read(const std::string& netlist, const std::filesystem::path& folder, const std::filesystem::path& library);

}  // namespace rheonet::test
