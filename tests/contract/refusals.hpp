#pragma once

#include <vector>

namespace rheonet::test {

struct Refusal {
  const char* what;
  const char* netlist;  ///< begins with a line break; without a [simulate] it runs for 1 s
  const char* message;  ///< exactly; one of the reader begins with a line break
};

/// Checks that each netlist is refused with exactly its message, by the reader or by the run.
void check_refusals(const std::vector<Refusal>& refusals);

}  // namespace rheonet::test
